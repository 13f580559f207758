// SPDX-License-Identifier: BSD-3-Clause
// Estimates the inertia of motor and link together, payload included, from torque and change of velocity. Real-time safe. Joint side, SI.
//
//   J (w(t) - w(t - T)) = I(t) - I(t - T) - k (R(t) - R(t - T)) - c T
//   I = integral of (torque - known load),   R = integral of the table's friction, with the sign of the motion
//
// Recursive least squares with forgetting fits J, k and c over windows of T: k is the friction relative to the table's, c an unknown load.
// Means of w, I and R over 4 ms smooth the encoder's counts, and the equation stays exact. T is 20 ms, about one swing of the gear's
// spring (catalogue: 12 to 36 ms), so that motor and link act as one inertia. Only windows of motion in one direction count, since
// static friction balances any torque. The prior is k = 1, c = 0; the configured J is not used.
#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

#include "control/joint/joint_measurement.h"
#include "control/joint/joint_model.h"

namespace strainwave {

struct InertiaEstimateConfig {
  double period_s = 0.001;  ///< > 0
  double count_rad = 1e-6;  ///< > 0: resolution of the encoder
  int delay_periods = 0;    ///< between a torque's command and its effect, 0..kMaxControlDelay
};

class InertiaEstimate {
 public:
  /// State at the end of a period.
  struct Sample {
    double position_rad = 0.0;
    /// The torque commanded at the beginning of the period, after all limits, and the known load. Both act after the delay.
    double torque_Nm = 0.0;
    double known_load_Nm = 0.0;
  };

  explicit InertiaEstimate(const InertiaEstimateConfig& config) noexcept;

  /// Takes the sample of the next period; `model` gives the table's friction and its scale. If a reading is missing or a period was left
  /// out, call interrupt() instead.
  void step(const Sample& sample, const JointModel& model) noexcept;
  void interrupt() noexcept { samples_ = moving_ = 0; }
  /// Forgets the estimate, for a load that may have changed.
  void forget() noexcept;

  /// In kg m2, if its standard deviation is at most kKnown of it and the windows suffice.
  std::optional<double> inertia_kgm2() const noexcept;
  /// Standard deviation of the estimate; meaningless before the first windows.
  double deviation_kgm2() const noexcept { return deviation_kgm2_; }

  static constexpr double kKnown = 0.1;

 private:
  static constexpr unsigned kRoom =
      512U;  ///< a power of two, above the longest span, window and delay together

  struct Sums {
    double position_rad = 0.0;
    double impulse_Nms = 0.0;   ///< I
    double friction_Nms = 0.0;  ///< R
  };
  /// Means over a span.
  struct Means {
    double velocity_rad_s = 0.0;
    double impulse_Nms = 0.0;
    double friction_Nms = 0.0;
  };
  const Sums& sums(int periods_ago) const noexcept;
  Means means(int periods_ago) const noexcept;
  void learn(double friction_scale_Nm) noexcept;

  InertiaEstimateConfig config_;
  int span_;                               ///< periods of a mean
  int window_;                             ///< T, periods
  std::array<double, kRoom> torque_Nm_{};  ///< commanded torque less known load
  std::array<Sums, kRoom> sums_{};
  unsigned now_ = 0;
  int samples_ = 0;  ///< in a row, without a gap
  int moving_ = 0;   ///< of these, the latest ones of motion in one direction
  int way_ = 0;
  // Normal equations of [J, k, c] and the sum of the squared residuals, each window in units of its noise.
  Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
  double squares_ = 0.0;
  double windows_ = 0.0;
  double inertia_kgm2_ = 0.0;
  double deviation_kgm2_ = 0.0;
};

}  // namespace strainwave
