// SPDX-License-Identifier: BSD-3-Clause
// The cascade of a simulated servo drive, in the drive's units: a proportional position loop around a proportional-integral velocity
// loop. The setpoint of a SYNC is reached at the next one, on a straight line. Without another SYNC the drive stays there.
#pragma once

#include <cmath>
#include <optional>

namespace strainwave::can_nodes {

struct MotionLoopConfig {
  double period_s = 1e-3;
  double velocity_bandwidth_rad_s = 200.0;
  double permille_per_count_s2 = 0.0;  ///< the inertia, in the drive's units
};

class MotionLoop {
 public:
  struct Setpoint {
    std::optional<double> position_counts;  ///< none: velocity only
    double velocity_counts_s = 0.0;
  };

  explicit MotionLoop(const MotionLoopConfig& config) : config_(config) {}

  /// Power was switched on or off.
  void begin(double counts) {
    before_ = counts;
    integral_ = 0.0;
    aim_.reset();
    error_ = 0.0;
  }
  void take(const Setpoint& setpoint, double until_next_s) {
    if (setpoint.position_counts) {
      // This line begins at the end of the last one.
      place_ = aim_.value_or(*setpoint.position_counts);
      slope_ = (*setpoint.position_counts - *place_) / until_next_s;
    }
    aim_ = setpoint.position_counts;
    setpoint_ = setpoint;
  }
  /// One period. Returns the torque in per mille.
  double step(double counts) {
    const double velocity = (counts - before_) / config_.period_s;
    before_ = counts;
    double wanted = setpoint_.velocity_counts_s;
    if (aim_ && place_) {
      wanted += 0.25 * config_.velocity_bandwidth_rad_s * (*place_ - counts);
      error_ = std::abs(*place_ - counts);
      const double left = *aim_ - *place_;
      const double step = slope_ * config_.period_s;
      *place_ = std::abs(step) < std::abs(left) ? *place_ + step : *aim_;
    }
    const double proportional =
        config_.velocity_bandwidth_rad_s * config_.permille_per_count_s2 * (wanted - velocity);
    last_ = 0.5 * config_.velocity_bandwidth_rad_s * config_.period_s * proportional;
    integral_ += last_;
    return proportional + integral_;
  }
  /// The torque of this step was limited: takes back its share of the integral (anti-windup).
  void was_limited() { integral_ -= last_; }
  /// Magnitude of the position error; 0 without a position loop.
  double error_counts() const { return error_; }

 private:
  MotionLoopConfig config_;
  Setpoint setpoint_;
  std::optional<double> aim_;
  std::optional<double> place_;
  double slope_ = 0.0;
  double before_ = 0.0;
  double integral_ = 0.0;
  double last_ = 0.0;
  double error_ = 0.0;
};

}  // namespace strainwave::can_nodes
