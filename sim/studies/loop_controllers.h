// SPDX-License-Identifier: BSD-3-Clause
// The controllers of chapter 6 as the closed loop runs them: a gain table's controller and the PID of Zhao (2006).
// torque_Nm() is real-time safe.
#pragma once

#include <limits>
#include <optional>

#include "control/joint/joint_measurement.h"
#include "control/scheduled_controller.h"
#include "sim/studies/closed_loop.h"

namespace strainwave {

/// Returns the measurement of `sample` for the daemon's controller. The temperature may differ from the sensor's; NaN: not known.
JointMeasurement measurement_of(const LoopSample& sample, double temperature_C) noexcept;

/// Backward difference of the measured position, from which Zhao (2006) takes the velocity; 0 at the first
/// sample.
class BackwardDifference {
 public:
  explicit BackwardDifference(double period_s) noexcept : period_s_(period_s) {}
  double step(double position_rad) noexcept {
    const double velocity_rad_s = last_ ? (position_rad - *last_) / period_s_ : 0.0;
    last_ = position_rad;
    return velocity_rad_s;
  }
  void reset() noexcept { last_.reset(); }

 private:
  double period_s_;
  std::optional<double> last_;
};

/// C1..C4: the state feedback of control/, scheduled or without temperature. The velocity is exact if the plant offers it,
/// otherwise the backward difference. There is no plan. With temperature, friction is compensated in the direction of the setpoint.
///
///   d = sign(setpoint - position)
///   moving    f = alpha_0 Fs(T) d + (1 - alpha_0) Fc(T) sign(velocity)
///   at rest   f = 1.1 Fs(T) d, farther than 1e-6 rad from the setpoint
///
/// Source: Zhao (2006), (3-9)..(3-35), section 5.4. He states neither the sign d, here the direction to the
/// setpoint, nor that a joint at rest needs all of Fs to move again.
class FeedbackLoopController final : public LoopController {
 public:
  /// `gains` are those of the table; `torque_limit_Nm` may be infinite.
  FeedbackLoopController(const FeedbackGains& gains, const FuzzyFriction& friction,
                         const PlantIdentity& plant, double torque_limit_Nm) noexcept;

  double torque_Nm(const LoopSample& sample) noexcept override;
  void reset() noexcept override;

 private:
  double friction_torque_Nm(const ControllerInput& input) const noexcept;

  ScheduledController controller_;
  FuzzyFriction table_;
  FrictionParameters friction_;  ///< at the last temperature
  bool compensates_;
  BackwardDifference difference_;
  double torque_limit_Nm_;
  double temperature_C_ = std::numeric_limits<double>::quiet_NaN();  ///< of the last layer-1 evaluation
  std::optional<double> last_setpoint_rad_;
};

/// Gains of the PID of Zhao (2006) on e = setpoint - position.
struct PidGains {
  double proportional_Nm_rad = 430.1;
  double integral_Nm_rads = 1430.1;
  double derivative_Nms_rad = 7.95;
};

/// The PID of Zhao (2006): P e + I sum ts e + D (e_k - e_(k-1)) / ts, no anti-windup. Before the first sample the
/// error is taken as that of the first sample.
class PidLoopController final : public LoopController {
 public:
  PidLoopController(const PidGains& gains, double period_s) noexcept
      : gains_(gains), period_s_(period_s), derivative_(period_s) {}

  double torque_Nm(const LoopSample& sample) noexcept override;
  void reset() noexcept override;

 private:
  PidGains gains_;
  double period_s_;
  BackwardDifference derivative_;
  double integral_rads_ = 0.0;
};

}  // namespace strainwave
