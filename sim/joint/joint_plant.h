// SPDX-License-Identifier: BSD-3-Clause
// One joint as the controller sees it, one period at a time: physics, motor, encoder, heat and the delay of
// the computer. Real-time safe except for the constructor.
#pragma once

#include "control/joint/encoder_side.h"
#include "sim/joint/delay_line.h"
#include "sim/joint/encoder.h"
#include "sim/joint/flexible_physics.h"
#include "sim/joint/thermal.h"

namespace strainwave {

struct JointPlantConfig {
  JointParameters joint;                       ///< with a transmission, the motor's inertia alone
  JointEffects effects;                        ///< default: one rigid inertia
  MotorLimits motor;                           ///< default: no limit
  Encoder encoder;                             ///< encoder on the motor's side; default: ideal
  Encoder link_encoder;                        ///< second encoder, on the link; 0 counts: none
  EncoderSide feedback = EncoderSide::kMotor;  ///< whose position the drive reports as the joint's
  ThermalParameters thermal;                   ///< default: no heating, no lag
  double winding_loss_W_Nm2 = 0.0;             ///< R / Kt^2: heat in the winding per square of the torque
  double period_s = 1e-3;                      ///< > 0
  int substeps = 10;                           ///< integration steps per period, 1..10000
  DelayConfig delay;                           ///< delay from a command to its effect
  double initial_position_rad = 0.0;
};

class JointPlant {
 public:
  /// Throws InputError naming the key, the value and what is allowed.
  explicit JointPlant(const JointPlantConfig& config);

  /// Begins a period at this finite temperature of the surroundings. The sensors may be read afterwards.
  void set_ambient_temperature(double ambient_temperature_C) noexcept {
    thermal_.set_ambient(ambient_temperature_C);
  }

  /// Completes the period: `torque_Nm` enters the delay line, and the torque that leaves it acts.
  /// `load_torque_Nm` opposes positive motor torque. Both must be finite.
  void step(double torque_Nm, double load_torque_Nm = 0.0) noexcept;

  /// Empties the delay line: no torque until a new command arrives (the drive was disabled).
  void clear_pending_torque() noexcept { delay_.clear(); }

  const JointPlantConfig& config() const noexcept { return config_; }
  /// State of the motor's side, which is the whole of a rigid joint.
  const JointState& state() const noexcept { return state_.motor; }
  /// State of the link. A rigid joint has the same state on both sides.
  const JointState& link_state() const noexcept { return effects_ ? state_.link : state_.motor; }
  /// State of the side that `feedback` names.
  const JointState& feedback_state() const noexcept {
    return config_.feedback == EncoderSide::kLink ? link_state() : state();
  }
  /// The present reading of the encoder that the drive reports.
  double measured_position_rad() const noexcept {
    return config_.feedback == EncoderSide::kLink ? measured_link_position_rad()
                                                  : config_.encoder.measure_rad(state_.motor.position_rad);
  }
  bool has_link_encoder() const noexcept { return config_.link_encoder.counts_per_joint_revolution > 0.0; }
  /// The present reading of the second encoder; without one, the link's true position.
  double measured_link_position_rad() const noexcept {
    return config_.link_encoder.measure_rad(link_state().position_rad);
  }
  /// Motor torque over the last period: the command after delay and limits, at the velocity of the period's end.
  double applied_torque_Nm() const noexcept { return applied_Nm_; }
  /// Temperature of the joint's lubricant, and the reading of its sensor.
  double joint_temperature_C() const noexcept { return thermal_.joint_C(); }
  double sensor_temperature_C() const noexcept { return thermal_.sensor_C(); }
  double time_s() const noexcept { return static_cast<double>(periods_) * config_.period_s; }

 private:
  double advance_with(double torque_Nm, double load_torque_Nm, double share) noexcept;
  double energy_J() const noexcept;
  const FrictionParameters& friction_at(double temperature_C) noexcept;

  JointPlantConfig config_;
  FlexibleJoint flexible_;
  bool effects_;  ///< false: rigid physics, which use only the motor's state
  FlexibleState state_;
  ThermalModel thermal_;
  DelayLine delay_;
  long periods_ = 0;
  double applied_Nm_ = 0.0;
  double friction_temperature_C_;  ///< NaN until friction_ is known
  FrictionParameters friction_;
};

}  // namespace strainwave
