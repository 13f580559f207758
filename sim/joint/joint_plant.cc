// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/joint_plant.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/input_error.h"
#include "base/printable.h"

namespace strainwave {

namespace {

void require(bool valid, const char* key, double value, const std::string& allowed) {
  if (!valid) throw InputError("simulated joint", key, number_text(value), allowed);
}

bool finite_and_not_negative(double value) {
  return std::isfinite(value) && value >= 0.0;
}

void check(const Transmission& gear) {
  const TorsionSpring& spring = gear.spring;
  require(std::isfinite(gear.link_inertia_kgm2) && gear.link_inertia_kgm2 > 0.0, "link.inertia_kgm2",
          gear.link_inertia_kgm2, "must be finite and > 0");
  for (const auto& [key, value] : {std::pair{"spring.stiffness_1_Nm_rad", spring.stiffness_1_Nm_rad},
                                   std::pair{"spring.stiffness_2_Nm_rad", spring.stiffness_2_Nm_rad},
                                   std::pair{"spring.stiffness_3_Nm_rad", spring.stiffness_3_Nm_rad}})
    require(std::isfinite(value) && value > 0.0, key, value, "must be finite and > 0");
  require(finite_and_not_negative(spring.torque_1_Nm), "spring.torque_1_Nm", spring.torque_1_Nm,
          "must be finite and >= 0");
  require(std::isfinite(spring.torque_2_Nm) && spring.torque_2_Nm >= spring.torque_1_Nm, "spring.torque_2_Nm",
          spring.torque_2_Nm, "must be finite and at least torque_1_Nm");
  for (const auto& [key, value] : {std::pair{"spring.damping_Nms_rad", gear.damping_Nms_rad},
                                   std::pair{"spring.lost_motion_rad", gear.lost_motion.width_rad},
                                   std::pair{"link.coulomb_Nm", gear.link_coulomb_Nm},
                                   std::pair{"link.viscous_Nms_rad", gear.link_viscous_Nms_rad}})
    require(finite_and_not_negative(value), key, value, "must be finite and >= 0");
}

// The lowest temperature that the checks allow for, since friction grows in the cold.
constexpr double kColdest_C = -40.0;

// Coulomb friction must not exceed static friction: otherwise the motor would stop and break away endlessly.
void check_friction(const ExponentialTemperatureLaw& law) {
  require(
      law.asymptote.static_Nm >= law.asymptote.coulomb_Nm, "friction.asymptote_static_Nm",
      law.asymptote.static_Nm,
      "at least friction.asymptote_coulomb_Nm = " + number_text(law.asymptote.coulomb_Nm) + " is allowed");
  const FrictionParameters cold = law.at(kColdest_C);
  require(cold.static_Nm >= cold.coulomb_Nm, "friction.amplitude_static_Nm", law.amplitude.static_Nm,
          "must be larger: at " + number_text(kColdest_C) + " degC static friction is " +
              number_text(cold.static_Nm) + " N.m, below the Coulomb friction of " +
              number_text(cold.coulomb_Nm) + " N.m");
}

// Motor and bristles oscillate at sqrt(Fs / (J presliding)) with half of critical damping. A sub-step bears at most 1 rad of it.
void check_presliding(const JointPlantConfig& c) {
  const double presliding_rad = c.effects.friction.presliding_rad;
  if (presliding_rad <= 0.0) return;
  require(c.joint.friction.asymptote.static_Nm > 0.0, "friction.asymptote_static_Nm",
          c.joint.friction.asymptote.static_Nm, "more than 0 is allowed with presliding");
  const double fastest_rad_s = c.substeps / c.period_s;
  const double static_Nm = c.joint.friction.at(kColdest_C).static_Nm;
  const double least_rad = static_Nm / (c.joint.inertia_kgm2 * fastest_rad_s * fastest_rad_s);
  require(presliding_rad >= least_rad, "sliding.presliding_rad", presliding_rad,
          "0, or at least " + number_text(least_rad) + " with " + std::to_string(c.substeps) +
              " sub-steps is allowed (the friction of -40 degC on this inertia)");
}

// Limits for the integration: in a sub-step the fastest oscillation turns by at most 1 rad, and the fastest decay reaches at most e^-2.
void check_substeps(const JointPlantConfig& c) {
  const JointEffects& e = c.effects;
  constexpr double kLargestDecay = 2.0;
  double swing_rad_s = 0.0;
  double decay_1_s = (1.0 + std::abs(e.friction.direction_share)) *
                     c.joint.friction.at(kColdest_C).viscous_Nms_rad / c.joint.inertia_kgm2;
  double link_inertia_kgm2 = c.joint.inertia_kgm2;
  if (e.transmission) {
    link_inertia_kgm2 = e.transmission->link_inertia_kgm2;
    const TorsionSpring& spring = e.transmission->spring;
    const double stiffest =
        std::max({spring.stiffness_1_Nm_rad, spring.stiffness_2_Nm_rad, spring.stiffness_3_Nm_rad});
    swing_rad_s = free_free_frequency_rad_s(c.joint.inertia_kgm2, link_inertia_kgm2, stiffest);
    decay_1_s += e.transmission->damping_Nms_rad * (1.0 / c.joint.inertia_kgm2 + 1.0 / link_inertia_kgm2) +
                 e.transmission->link_viscous_Nms_rad / link_inertia_kgm2;
  }
  swing_rad_s = std::hypot(swing_rad_s, std::sqrt(e.contact.stiffness_Nm_rad / link_inertia_kgm2));
  decay_1_s += e.contact.damping_Nms_rad / link_inertia_kgm2;
  const double needed = std::ceil(c.period_s * std::max(swing_rad_s, decay_1_s / kLargestDecay));
  if (needed > c.substeps)
    throw InputError(
        "simulated joint", "substeps", std::to_string(c.substeps),
        "at least " + std::to_string(static_cast<long long>(std::min(needed, 1e18))) +
            " are needed for this joint's fastest swing and decay; or take a softer spring or contact, "
            "less damping or viscous friction (counted at -40 degC), or more inertia");
}

void check(const JointEffects& e) {
  require(std::isfinite(e.gear_ratio) && e.gear_ratio > 0.0, "gear_ratio", e.gear_ratio,
          "must be finite and > 0");
  for (const auto& [key, value] : {std::pair{"sliding.transmitted_share", e.friction.transmitted_share},
                                   std::pair{"sliding.presliding_rad", e.friction.presliding_rad},
                                   std::pair{"drive.current_loop_s", e.drive.current_loop_s},
                                   std::pair{"gravity.torque_Nm", e.gravity.torque_Nm},
                                   std::pair{"contact.stiffness_Nm_rad", e.contact.stiffness_Nm_rad},
                                   std::pair{"contact.damping_Nms_rad", e.contact.damping_Nms_rad}})
    require(finite_and_not_negative(value), key, value, "must be finite and >= 0");
  require(std::abs(e.friction.direction_share) < 1.0, "sliding.direction_share", e.friction.direction_share,
          "must be in (-1, 1)");
  require(e.drive.ripple_share >= 0.0 && e.drive.ripple_share < 1.0, "drive.ripple_share",
          e.drive.ripple_share, "must be in [0, 1)");
  if (e.transmission) check(*e.transmission);
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
  require(finite_and_not_negative(c.motor.torque_per_speed_Nms_rad), "torque_per_speed_Nms_rad",
          c.motor.torque_per_speed_Nms_rad, "must be finite and >= 0");
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
  require(c.delay.periods >= 0.0 && c.delay.periods <= kMaxDelayPeriods, "delay_periods", c.delay.periods,
          "must be in 0..16");
  require(c.delay.jitter_periods >= 0.0 && c.delay.jitter_periods <= 4.0, "jitter_periods",
          c.delay.jitter_periods, "must be in 0..4");
  require(std::isfinite(c.initial_position_rad), "initial_position_rad", c.initial_position_rad,
          "must be finite");
  require(c.feedback == EncoderSide::kMotor || c.link_encoder.counts_per_joint_revolution > 0.0,
          "link_counts_per_joint_revolution", c.link_encoder.counts_per_joint_revolution,
          "must be > 0 where the link's encoder is the feedback");
  check(c.effects);
  check_friction(c.joint.friction);
  check_presliding(c);
  check_substeps(c);
  return c;
}

/// The state at rest: spring, gravity and kinematic error balance at the link.
FlexibleState resting(const JointPlantConfig& c) {
  FlexibleState state;
  state.motor = state.link = {c.initial_position_rad, 0.0, true};
  if (!c.effects.transmission) return state;
  const Transmission& gear = *c.effects.transmission;
  const double unwound_rad =
      c.initial_position_rad + gear.kinematic_error.value_rad(c.effects.gear_ratio * c.initial_position_rad);
  const GravityLoad& gravity = c.effects.gravity;
  state.link.position_rad = unwound_rad;
  for (int i = 0; i < 50; ++i)
    state.link.position_rad = unwound_rad - gear.spring.angle_rad(gravity.at(state.link.position_rad));
  return state;
}

}  // namespace

JointPlant::JointPlant(const JointPlantConfig& config)
    : config_(checked(config)),
      flexible_{config.joint, config.effects},
      effects_(config.effects.any()),
      state_(resting(config)),
      thermal_(config.thermal, config.period_s),
      delay_(config.delay),
      friction_temperature_C_(std::numeric_limits<double>::quiet_NaN()) {}

const FrictionParameters& JointPlant::friction_at(double temperature_C) noexcept {
  if (temperature_C != friction_temperature_C_) {
    friction_ = config_.joint.friction.at(temperature_C);
    friction_temperature_C_ = temperature_C;
  }
  return friction_;
}

void JointPlant::step(double torque_Nm, double load_torque_Nm) noexcept {
  const double begin = static_cast<double>(periods_);
  const double end = begin + 1.0;
  delay_.push(begin, torque_Nm);
  double heat_J = 0.0;
  double now = begin;
  while (now < end) {
    const double acting_Nm = delay_.at(now);
    const double until = std::min(end, delay_.next_due());
    heat_J += advance_with(acting_Nm, load_torque_Nm, until - now);
    now = until;
  }
  const double winding_W = config_.winding_loss_W_Nm2 * applied_Nm_ * applied_Nm_;
  thermal_.add_loss(winding_W + heat_J / config_.period_s);
  ++periods_;
}

/// Advances by `share` of a period with one torque; returns the heat of friction in J.
double JointPlant::advance_with(double torque_Nm, double load_torque_Nm, double share) noexcept {
  const JointInput input{torque_Nm, load_torque_Nm, friction_at(thermal_.joint_C()), config_.motor};
  const double duration_s = share * config_.period_s;
  const int substeps = share < 1.0 ? static_cast<int>(std::ceil(share * config_.substeps)) : config_.substeps;
  const FlexibleState before = state_;
  const double before_J = energy_J();
  if (effects_) {
    advance(state_, flexible_, input, duration_s, substeps);
    applied_Nm_ = motor_torque_Nm(flexible_, state_, input);
  } else {
    advance(state_.motor, config_.joint, input, duration_s, substeps);
    applied_Nm_ = config_.motor.limit_Nm(input.torque_Nm, state_.motor.velocity_rad_s);
  }
  // The work of friction is the torques' work less the gain in energy. Rounding may make it slightly negative.
  const double motor_rad = state_.motor.position_rad - before.motor.position_rad;
  const double loaded_rad = effects_ ? state_.link.position_rad - before.link.position_rad : motor_rad;
  const double work_J = applied_Nm_ * motor_rad - load_torque_Nm * loaded_rad;
  return std::max(0.0, work_J - (energy_J() - before_J));
}

double JointPlant::energy_J() const noexcept {
  return effects_ ? mechanical_energy_J(flexible_, state_) : kinetic_energy(config_.joint, state_.motor);
}

}  // namespace strainwave
