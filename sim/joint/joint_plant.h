// One joint as a controller meets it: physics, motor, encoder, heat and the delay of the computer, a period
// at a time. Real-time safe except for the constructor.
#pragma once

#include <array>
#include <cstddef>

#include "sim/joint/encoder.h"
#include "sim/joint/joint_physics.h"
#include "sim/joint/thermal.h"

namespace strainwave {

inline constexpr int kMaxDelaySamples = 16;

struct JointPlantConfig {
  JointParameters joint;
  MotorLimits motor;                ///< default: no limit
  Encoder encoder;                  ///< default: ideal
  ThermalParameters thermal;        ///< default: no heating, no lag
  double winding_loss_W_Nm2 = 0.0;  ///< R / Kt^2: heat of holding a torque
  double period_s = 1e-3;           ///< > 0
  int substeps = 10;                ///< integration steps per period, 1..10000
  int delay_samples = 0;            ///< periods from a command to its effect, 0..kMaxDelaySamples
  double initial_position_rad = 0.0;
};

class JointPlant {
 public:
  /// Throws InputError naming the key, the value and what is allowed.
  explicit JointPlant(const JointPlantConfig& config);

  /// Start of a period: the temperature of the surroundings, finite. The sensors may be read after it.
  void set_ambient_temperature(double ambient_temperature_C) noexcept {
    thermal_.set_ambient(ambient_temperature_C);
  }

  /// The rest of the period: `torque_Nm` enters the delay line, the torque that leaves it acts.
  /// `load_torque_Nm` opposes positive motor torque. Both must be finite.
  void step(double torque_Nm, double load_torque_Nm = 0.0) noexcept;

  /// Empties the delay line: no torque until a new command arrives (the drive was disabled).
  void clear_pending_torque() noexcept { pending_Nm_.fill(0.0); }

  const JointPlantConfig& config() const noexcept { return config_; }
  const JointState& state() const noexcept { return state_; }
  /// What the encoder reads now.
  double measured_position_rad() const noexcept { return config_.encoder.measure_rad(state_.position_rad); }
  /// Motor torque over the last period: its command after delay and limits, at the velocity of the period's
  /// end.
  double applied_torque_Nm() const noexcept { return applied_Nm_; }
  /// Temperature of the joint's lubricant, and what the sensor shows.
  double joint_temperature_C() const noexcept { return thermal_.joint_C(); }
  double sensor_temperature_C() const noexcept { return thermal_.sensor_C(); }
  double time_s() const noexcept { return static_cast<double>(periods_) * config_.period_s; }

 private:
  double delayed(double torque_Nm) noexcept;
  const FrictionParameters& friction_at(double temperature_C) noexcept;

  JointPlantConfig config_;
  JointState state_;
  ThermalModel thermal_;
  std::array<double, kMaxDelaySamples> pending_Nm_{};
  std::size_t next_pending_ = 0;
  long periods_ = 0;
  double applied_Nm_ = 0.0;
  double friction_temperature_C_;  ///< NaN until friction_ is known
  FrictionParameters friction_;
};

}  // namespace strainwave
