#include "control/joint_controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "control/units.h"

namespace strainwave {

namespace {

// The Stribeck velocity as a share of the width of the table's "zero velocity" membership, and its exponent.
constexpr double kStribeckShare = 0.5;
constexpr double kStribeckExponent = 2.0;
// Acceleration that a reference may always have, as a share of what the torque limit could give without
// friction.
constexpr double kLeastAcceleration = 0.02;
// A landing push uses this share of what one period can reach.
constexpr double kLandingReach = 0.5;
// A tracking error that one period at this share of the torque limit makes up for needs no new plan.
constexpr double kReplanReach = 2.0;

VelocityObserverConfig observer_config(const JointControllerConfig& config) noexcept {
  VelocityObserverConfig observer;
  observer.period_s = config.period_s;
  observer.encoder_resolution_rad = config.encoder_resolution_rad;
  return observer;
}

LandingConfig landing_config(const JointControllerConfig& config) noexcept {
  LandingConfig landing;
  landing.period_s = config.period_s;
  landing.encoder_resolution_rad = config.encoder_resolution_rad;
  landing.delay_samples = config.delay_samples;
  return landing;
}

}  // namespace

double MotorLimits::available_Nm(double velocity_rad_s) const noexcept {
  return std::max(0.0, std::min(peak_torque_Nm, stall_torque_Nm - torque_per_speed_Nms_rad * velocity_rad_s));
}

JointController::JointController(const JointControllerConfig& config) noexcept
    : config_(config),
      shaper_(config.period_s),
      observer_(observer_config(config)),
      landing_(landing_config(config)),
      rest_detector_(config.encoder_resolution_rad) {
  assert(config.delay_samples >= 0 && config.delay_samples <= kMaxControlDelay);
  shaper_.set_limits(config.motion);
}

void JointController::load(const GainTable& table) noexcept {
  primary_ = ScheduledController(table.primary, table.friction, table.plant);
  fallback_ = ScheduledController(table.fallback, table.friction, table.plant);
  if (has_temperature_) primary_.set_temperature(scheduled_temperature_C_);
  model_.inertia_kgm2 = table.plant.inertia_kgm2;
  model_.stribeck = {kStribeckShare * table.friction.velocity.zero_width_rad_s, kStribeckExponent};
  model_.friction = primary_.friction();
  table_torque_limit_Nm_ = std::min(table.torque_limit_Nm, config_.torque_limit_Nm);
  carry_over_ = gains_in_use_ != GainsInUse::kNone;
  has_table_ = true;
}

void JointController::start(double position_rad) noexcept {
  shaper_.reset(position_rad, 0.0);
  observer_.reset(position_rad);
  primary_.reset();
  fallback_.reset();
  rest_detector_.reset();
  torques_Nm_.fill(0.0);
  gains_in_use_ = GainsInUse::kNone;
  phase_ = MotionPhase::kTracking;
  reference_ = {position_rad, 0.0, 0.0};
  previous_position_rad_ = position_rad;
  started_ = false;
  carry_over_ = false;
  replan_ = false;
}

void JointController::set_target(double position_rad) noexcept {
  if (position_rad == shaper_.target_rad() && phase_ != MotionPhase::kTracking) return;
  shaper_.set_target(position_rad);
  phase_ = MotionPhase::kTracking;
}

void JointController::stop() noexcept {
  shaper_.stop();
}

JointStep JointController::step(const JointMeasurement& measurement) noexcept {
  if (!has_table_) return {};
  choose_gains(measurement);
  estimate_state(measurement);
  look_ahead();
  advance_reference();
  choose_phase(measurement);
  const ControllerOutput output = phase_ == MotionPhase::kTracking  ? track()
                                  : phase_ == MotionPhase::kLanding ? land(measurement)
                                                                    : rest();
  remember(output.torque_Nm);
  return {output, reference_, then_.velocity_rad_s, gains_in_use_, shaper_.at_target(), phase_, now_};
}

// Scheduled gains while the temperature is known, temperature-free ones otherwise.
void JointController::choose_gains(const JointMeasurement& measurement) noexcept {
  const GainsInUse wanted = measurement.temperature_valid ? GainsInUse::kPrimary : GainsInUse::kFallback;
  if (wanted != gains_in_use_) {
    carry_over_ = gains_in_use_ != GainsInUse::kNone;
    gains_in_use_ = wanted;
  }
  if (!measurement.temperature_valid) return;
  if (has_temperature_ && measurement.temperature_C == scheduled_temperature_C_) return;
  primary_.set_temperature(measurement.temperature_C);
  model_.friction = primary_.friction();
  scheduled_temperature_C_ = measurement.temperature_C;
  has_temperature_ = true;
}

void JointController::estimate_state(const JointMeasurement& measurement) noexcept {
  const double position_rad = measurement.joint_position_rad;
  if (config_.use_observer) {
    if (started_) observer_.predict(torques_Nm_[static_cast<std::size_t>(config_.delay_samples)], model_);
    if (measurement.has_velocity && config_.encoder_resolution_rad == 0.0)
      observer_.correct(position_rad, measurement.joint_velocity_rad_s);
    else
      observer_.correct(position_rad);
    now_ = observer_.estimate();
    adapted_ = model_;
    adapted_.inertia_kgm2 *= now_.inertia_ratio;
  } else {
    const double difference_rad_s = (position_rad - previous_position_rad_) / config_.period_s;
    now_ = {position_rad,
            measurement.has_velocity ? measurement.joint_velocity_rad_s : difference_rad_s,
            {},
            1.0,
            0.0};
    adapted_ = model_;
  }
  previous_position_rad_ = position_rad;
  started_ = true;
}

// The torques that are under way already decide the joint's motion until this period's torque acts.
void JointController::look_ahead() noexcept {
  then_ = now_;
  if (!config_.use_observer) return;
  for (int i = config_.delay_samples - 1; i >= 0; --i) {
    const ModelMotion motion = adapted_.advance(torques_Nm_[static_cast<std::size_t>(i)], then_.disturbance,
                                                then_.velocity_rad_s, config_.period_s);
    then_.position_rad += motion.displacement_rad;
    then_.velocity_rad_s = motion.velocity_rad_s;
  }
}

// What torque, supply, friction and load leave for acceleration at the reference's speed.
MotionLimits JointController::reachable_limits() const noexcept {
  const double speed =
      std::abs(reference_.velocity_rad_s + config_.period_s * reference_.acceleration_rad_s2);
  const double usable = 1.0 - config_.torque_reserve;
  const double limit_Nm = usable * std::min(table_torque_limit_Nm_, config_.motor.peak_torque_Nm);
  const double supply_Nm =
      usable * config_.motor.stall_torque_Nm - config_.motor.torque_per_speed_Nms_rad * speed;
  const double coulomb_Nm = std::max(0.0, adapted_.friction.coulomb_Nm + now_.disturbance.friction_offset_Nm);
  const double load_Nm = std::abs(now_.disturbance.load_Nm);
  // Speed and with it the losses grow over the period: linear in the acceleration, so solved for it.
  const bool supply_limits = supply_Nm < limit_Nm;
  const double damping =
      adapted_.friction.viscous_Nms_rad + (supply_limits ? config_.motor.torque_per_speed_Nms_rad : 0.0);
  const double driving_Nm =
      std::min(limit_Nm, supply_Nm) - coulomb_Nm - load_Nm - adapted_.friction.viscous_Nms_rad * speed;
  const double least = kLeastAcceleration * limit_Nm / adapted_.inertia_kgm2;
  const double acceleration = driving_Nm / (adapted_.inertia_kgm2 + config_.period_s * damping);
  const double deceleration = (limit_Nm + coulomb_Nm - load_Nm) / adapted_.inertia_kgm2;
  return {config_.motion.velocity_rad_s,
          std::min(config_.motion.acceleration_rad_s2, std::max(least, acceleration)),
          std::min(config_.motion.deceleration_rad_s2, std::max(least, deceleration))};
}

void JointController::advance_reference() noexcept {
  if (!config_.use_shaping) {
    shaper_.jump();
    reference_ = {shaper_.target_rad(), 0.0, 0.0};
    return;
  }
  if (replan_) shaper_.restart(then_.position_rad, then_.velocity_rad_s);
  replan_ = false;
  shaper_.set_limits(reachable_limits());
  reference_ = shaper_.step();
}

// One push and one period's braking, with a share of the torque, can end on the target.
bool JointController::within_landing_reach() const noexcept {
  const double torque_Nm = kLandingReach * (table_torque_limit_Nm_ - adapted_.friction.static_Nm);
  const double reach_rad_s = torque_Nm * config_.period_s / adapted_.inertia_kgm2;
  return std::abs(then_.position_rad - shaper_.target_rad()) <= reach_rad_s * config_.period_s &&
         std::abs(then_.velocity_rad_s) <= reach_rad_s;
}

void JointController::choose_phase(const JointMeasurement& measurement) noexcept {
  const bool ended =
      shaper_.at_target() && reference_.velocity_rad_s == 0.0 && reference_.acceleration_rad_s2 == 0.0;
  if (!config_.use_rest || !ended) {
    phase_ = MotionPhase::kTracking;
    rest_detector_.reset();
    return;
  }
  if (!config_.use_landing || !config_.use_observer) {
    const bool resting =
        rest_detector_.update(measurement.joint_position_rad - shaper_.target_rad(), now_.velocity_rad_s);
    phase_ = resting ? MotionPhase::kResting : MotionPhase::kTracking;
    return;
  }
  if (!within_landing_reach()) {
    replan_ = phase_ != MotionPhase::kTracking || config_.use_shaping;
    phase_ = MotionPhase::kTracking;
  } else if (phase_ == MotionPhase::kTracking) {
    landing_.begin(shaper_.target_rad());
    phase_ = MotionPhase::kLanding;
  } else if (phase_ == MotionPhase::kResting && std::abs(now_.position_rad - shaper_.target_rad()) >
                                                    std::max(1e-6, config_.encoder_resolution_rad)) {
    landing_.begin(shaper_.target_rad());
    phase_ = MotionPhase::kLanding;
  }
}

// Inertia at the reference's acceleration, friction at its speed in the middle of the period, load.
double JointController::planned_torque_Nm() const noexcept {
  const double velocity = reference_.velocity_rad_s + 0.5 * config_.period_s * reference_.acceleration_rad_s2;
  const double friction_Nm = adapted_.friction_Nm(velocity) + now_.disturbance.friction_offset_Nm;
  return adapted_.inertia_kgm2 * reference_.acceleration_rad_s2 +
         sign(velocity) * std::max(0.0, friction_Nm) + now_.disturbance.load_Nm;
}

ControllerOutput JointController::track() noexcept {
  ControllerInput input;
  input.joint_position_rad = then_.position_rad;
  input.joint_velocity_rad_s = then_.velocity_rad_s;
  input.setpoint_position_rad = reference_.position_rad;
  input.setpoint_velocity_rad_s = reference_.velocity_rad_s;
  input.planned =
      config_.use_shaping && (reference_.velocity_rad_s != 0.0 || reference_.acceleration_rad_s2 != 0.0);
  input.planned_torque_Nm = input.planned ? planned_torque_Nm() : now_.disturbance.load_Nm;
  input.torque_limit_Nm = table_torque_limit_Nm_;
  input.torque_max_Nm = config_.motor.available_Nm(then_.velocity_rad_s);
  input.torque_min_Nm = -config_.motor.available_Nm(-then_.velocity_rad_s);
  if (carry_over_) active().carry_over(input, torques_Nm_[0]);
  carry_over_ = false;
  const ControllerOutput output = active().step(input);
  const double reach_rad =
      kReplanReach * table_torque_limit_Nm_ * config_.period_s * config_.period_s / adapted_.inertia_kgm2;
  replan_ = replan_ || (output.saturated && config_.use_observer &&
                        std::abs(then_.position_rad - reference_.position_rad) > reach_rad);
  return output;
}

ControllerOutput JointController::land(const JointMeasurement& measurement) noexcept {
  const double torque_Nm = landing_.step(now_, then_, measurement.joint_position_rad, adapted_);
  if (landing_.resting()) phase_ = MotionPhase::kResting;
  return only_feedforward(torque_Nm);
}

ControllerOutput JointController::rest() noexcept {
  return only_feedforward(config_.use_landing && config_.use_observer ? now_.disturbance.load_Nm
                                                                      : hold_torque_Nm_);
}

ControllerOutput JointController::only_feedforward(double torque_Nm) const noexcept {
  const double limited_Nm = std::clamp(torque_Nm, -table_torque_limit_Nm_, table_torque_limit_Nm_);
  return {limited_Nm, 0.0, torque_Nm, 1.0, limited_Nm != torque_Nm};
}

void JointController::remember(double torque_Nm) noexcept {
  for (std::size_t i = torques_Nm_.size() - 1; i > 0; --i) torques_Nm_[i] = torques_Nm_[i - 1];
  const double along = torque_Nm < 0.0 ? -then_.velocity_rad_s : then_.velocity_rad_s;
  torques_Nm_[0] = std::copysign(std::min(std::abs(torque_Nm), config_.motor.available_Nm(along)), torque_Nm);
}

}  // namespace strainwave
