// SPDX-License-Identifier: BSD-3-Clause
// Windows of a recording, and both sides of the equation of motion integrated over them; see motion_fit.h. Not real-time.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "doctor/stretches.h"

namespace strainwave {

/// Columns of the equation. The last four: Jl times the amplitudes of the gear's kinematic error, once and twice per motor turn.
enum MotionQuantity { kMotor, kLink, kCoulomb, kViscous, kBias, kSine, kCosine, kError };
inline constexpr int kMotionColumns = 11;
using MotionRows = Eigen::Matrix<double, Eigen::Dynamic, kMotionColumns>;

/// Point about which the nonlinear equation of the link is linearised.
struct AssumedLink {
  std::array<double, 4> error_rad{};  ///< kinematic error: sine, cosine of the motor's angle, and of twice it
  double bias_Nm = 0.0, sine_Nm = 0.0, cosine_Nm = 0.0;  ///< load as a function of position
};

class MotionWindows {
 public:
  static constexpr double kErrorUnit_rad = 1e-4;  ///< unit of the columns from kError on
  static constexpr int kMostDelay = 8;            ///< periods

  /// `evidence` must outlive this object.
  explicit MotionWindows(const Evidence& evidence);

  int count() const noexcept { return static_cast<int>(windows_.size()); }
  /// Whether a spring is configured between motor and link, and the motor's position is measured.
  bool flexible() const noexcept { return evidence_.told.link && !evidence_.told.link->measured_at_link; }
  /// The left side, N.m, for a delay of 0 to kMostDelay periods.
  Eigen::VectorXd torques(double delay_periods) const;
  /// The right side's columns, with the configured spring times `scale`.
  MotionRows rows(double scale) const;
  /// Sets the point of linearisation for later calls of rows().
  void assume(const AssumedLink& link) { assumed_ = link; }
  const AssumedLink& assumed() const { return assumed_; }
  /// Positions in the middle of each window.
  std::vector<double> positions_rad() const;

 private:
  struct Window {
    const Stretch* stretch;
    int center;
  };
  void find_windows(const Stretch& stretch);
  double normaliser() const noexcept;
  std::array<std::vector<double>, 5> link_responses(const Stretch& stretch, double scale) const;

  const Evidence& evidence_;
  std::vector<Stretch> stretches_;
  std::vector<Window> windows_;
  AssumedLink assumed_;
  double step_s_ = 0.0;
  int half_ = 0;  ///< half a window, samples
};

}  // namespace strainwave
