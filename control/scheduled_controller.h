// Scheduled state feedback with integrator, friction feed-forward, saturation and anti-windup: the control law of one
// joint. Real-time safe: step() and set_temperature() allocate nothing and throw nothing.
//
//   e = position - setpoint,  x = [ integral e, e, velocity - setpoint velocity ]
//   u = (alpha_0 F_0 + (1 - alpha_0) sum_i w_i(T) F_i) x                                        feedback
//   d = drive direction;  f = (alpha_0 Fs(T) + (1 - alpha_0) Fc(T)) d                            friction feed-forward
//   r = J setpoint acceleration + (1 - alpha_0) Fv(T) setpoint velocity                          reference feed-forward
//   torque = clamp(u + f + r)
// Source: Zhao (2006), (3-9)..(3-35), section 5.4. Temperature-free controllers (one rule) know no friction: f = 0 and
// no viscous term, as in the source.
#pragma once

#include "control/gain_table.h"

namespace strainwave {

/// One period's input, joint side.
struct ControllerInput {
  double joint_position_rad = 0.0;
  double joint_velocity_rad_s = 0.0;
  double setpoint_position_rad = 0.0;
  double setpoint_velocity_rad_s = 0.0;       ///< 0 for a step reference
  double setpoint_acceleration_rad_s2 = 0.0;  ///< 0 for a step reference
  double torque_limit_Nm = 0.0;               ///< what the drive can deliver this period, >= 0
};

/// One period's result, joint side; torque_Nm = feedback + feedforward, limited.
struct ControllerOutput {
  double torque_Nm = 0.0;
  double feedback_torque_Nm = 0.0;
  double feedforward_torque_Nm = 0.0;
  double zero_velocity_weight = 1.0;  ///< alpha_0
  bool saturated = false;
};

class ScheduledController {
 public:
  ScheduledController() = default;
  /// `gains` and `friction` must have passed find_defect(); they are copied.
  ScheduledController(const FeedbackGains& gains, const FuzzyFriction& friction, const PlantIdentity& plant) noexcept;

  /// Layer 1: recomputes the temperature weights and everything that depends only on them. May be called at a slower
  /// rate than step(). The temperature must be finite; it is clamped to the table's range.
  void set_temperature(double temperature_C) noexcept;

  /// Layer 2 and the control law: one sample.
  ControllerOutput step(const ControllerInput& input) noexcept;

  /// Forgets the integral.
  void reset() noexcept { integral_rad_s_ = 0.0; }

  /// Chooses the integral so that step(input) would give `torque_Nm` (unless it saturates): the change-over from
  /// another controller makes no torque step. Without an integrator it does nothing.
  void carry_over(const ControllerInput& input, double torque_Nm) noexcept;

  const TemperatureWeights& temperature_weights() const noexcept { return weights_; }
  double integral_rad_s() const noexcept { return integral_rad_s_; }

 private:
  struct Terms {
    double feedback_Nm, feedforward_Nm, integral_gain, zero_weight;
  };
  Terms evaluate(const ControllerInput& input, double integral_rad_s) const noexcept;

  FeedbackGains gains_;
  FuzzyFriction friction_;
  PlantIdentity plant_;
  TemperatureWeights weights_;
  FrictionParameters blended_friction_;     ///< at the last temperature
  GainRow high_velocity_gain_ = GainRow::Zero();  ///< sum_i w_i F_i at the last temperature
  double integral_rad_s_ = 0.0;
};

}  // namespace strainwave
