#include "sim/joint/joint_plant.h"

#include <limits>
#include <string>
#include <utility>

#include "base/input_error.h"

namespace strainwave {

namespace {

void require(bool valid, const char* key, double value, const char* allowed) {
  if (!valid) throw InputError("simulated joint", key, std::to_string(value), allowed);
}

bool finite_and_not_negative(double value) {
  return std::isfinite(value) && value >= 0.0;
}

JointPlantConfig checked(const JointPlantConfig& c) {
  const auto positive = [](double value) { return std::isfinite(value) && value > 0.0; };
  require(positive(c.joint.inertia_kgm2), "inertia_kgm2", c.joint.inertia_kgm2, "must be finite and > 0");
  require(positive(c.joint.stribeck.velocity_rad_s), "stribeck_velocity_rad_s",
          c.joint.stribeck.velocity_rad_s, "must be finite and > 0");
  require(c.joint.stribeck.exponent >= 0.5 && std::isfinite(c.joint.stribeck.exponent), "stribeck_exponent",
          c.joint.stribeck.exponent, "must be finite and >= 0.5");
  require(positive(c.joint.friction.decay_C), "decay_C", c.joint.friction.decay_C, "must be finite and > 0");
  require(c.motor.peak_torque_Nm >= 0.0, "peak_torque_Nm", c.motor.peak_torque_Nm, "must be >= 0");
  require(c.motor.stall_torque_Nm >= 0.0, "stall_torque_Nm", c.motor.stall_torque_Nm, "must be >= 0");
  require(finite_and_not_negative(c.motor.torque_per_speed_Nms_rad), "torque_per_speed_Nms_rad", c.motor.torque_per_speed_Nms_rad,
          "must be finite and >= 0");
  require(finite_and_not_negative(c.encoder.counts_per_joint_revolution),
          "encoder_counts_per_joint_revolution", c.encoder.counts_per_joint_revolution,
          "must be finite and >= 0 (0: ideal)");
  require(finite_and_not_negative(c.thermal.resistance_C_W), "thermal_resistance_C_W",
          c.thermal.resistance_C_W, "must be finite and >= 0");
  require(positive(c.thermal.time_constant_s), "thermal_time_constant_s", c.thermal.time_constant_s,
          "must be finite and > 0");
  require(finite_and_not_negative(c.thermal.sensor_time_constant_s), "sensor_time_constant_s",
          c.thermal.sensor_time_constant_s, "must be finite and >= 0");
  require(finite_and_not_negative(c.winding_loss_W_Nm2), "winding_loss_W_Nm2", c.winding_loss_W_Nm2,
          "must be finite and >= 0");
  require(positive(c.period_s), "period_s", c.period_s, "must be finite and > 0");
  require(c.substeps >= 1 && c.substeps <= 10000, "substeps", c.substeps, "must be in 1..10000");
  require(c.delay_samples >= 0 && c.delay_samples <= kMaxDelaySamples, "delay_samples", c.delay_samples,
          "must be in 0..16");
  require(std::isfinite(c.initial_position_rad), "initial_position_rad", c.initial_position_rad,
          "must be finite");
  return c;
}

}  // namespace

JointPlant::JointPlant(const JointPlantConfig& config)
    : config_(checked(config)),
      state_{config.initial_position_rad, 0.0, true},
      thermal_(config.thermal, config.period_s),
      friction_temperature_C_(std::numeric_limits<double>::quiet_NaN()) {}

double JointPlant::delayed(double torque_Nm) noexcept {
  if (config_.delay_samples == 0) return torque_Nm;
  const double due_Nm = std::exchange(pending_Nm_[next_pending_], torque_Nm);
  next_pending_ = (next_pending_ + 1) % static_cast<std::size_t>(config_.delay_samples);
  return due_Nm;
}

const FrictionParameters& JointPlant::friction_at(double temperature_C) noexcept {
  if (temperature_C != friction_temperature_C_) {
    friction_ = config_.joint.friction.at(temperature_C);
    friction_temperature_C_ = temperature_C;
  }
  return friction_;
}

void JointPlant::step(double torque_Nm, double load_torque_Nm) noexcept {
  const JointInput input{delayed(torque_Nm), load_torque_Nm, friction_at(thermal_.joint_C()), config_.motor};
  const JointState before = state_;
  advance(state_, config_.joint, input, config_.period_s, config_.substeps);
  applied_Nm_ = config_.motor.limit_Nm(input.torque_Nm, state_.velocity_rad_s);

  // Friction's work is what the torques put in and the motion did not keep; rounding may make it slightly
  // negative.
  const double work_J = (applied_Nm_ - load_torque_Nm) * (state_.position_rad - before.position_rad);
  const double friction_J =
      work_J - (kinetic_energy(config_.joint, state_) - kinetic_energy(config_.joint, before));
  const double winding_W = config_.winding_loss_W_Nm2 * applied_Nm_ * applied_Nm_;
  thermal_.add_loss(winding_W + std::max(0.0, friction_J) / config_.period_s);
  ++periods_;
}

}  // namespace strainwave
