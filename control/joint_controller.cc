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
// Landing begins where one push with this share of the
// torque, and one period's braking, can end on the target.
constexpr double kLandingShare = 0.5;
// A landing that finds itself this many times farther away is given up: something pushed the joint.
constexpr double kLandingLost = 4.0;
// A saturated joint that is farther behind than this many such pushes needs a new plan.
constexpr double kReplanPushes = 4.0;
// New plans per target. A joint that is blocked uses them up, keeps its reference, and its following error
// grows until someone notices.
constexpr int kPlanLimit = 50;

// A landing takes some 100 periods. One that takes this many, or has to begin this often, does not come off
// (the delay or the encoder are not what the configuration says): feedback ends the motion, and after so many
// in a row no more are tried until start().
constexpr int kLandingPeriods = 400;
constexpr int kLandingBegins = 6;
constexpr int kLandingFailures = 3;
// Periods until the next try.
constexpr int kLandingPause = 500;
// Periods that a resting joint must be off its target before it moves again: a count may flicker.
constexpr int kLeavePeriods = 3;

VelocityObserverConfig observer_config(const JointControllerConfig& config) noexcept {
  VelocityObserverConfig observer;
  observer.period_s = config.period_s;
  observer.encoder_resolution_rad = config.encoder_resolution_rad;
  observer.edge_deviation_counts = config.encoder_deviation_counts;
  return observer;
}

LandingConfig landing_config(const JointControllerConfig& config) noexcept {
  LandingConfig landing;
  landing.period_s = config.period_s;
  landing.encoder_resolution_rad = config.encoder_resolution_rad;
  landing.delay_samples = config.delay_samples;
  return landing;
}

JointControllerConfig consistent(JointControllerConfig config) noexcept {
  config.use_landing = config.use_landing && config.use_observer && config.use_rest;
  return config;
}

}  // namespace

JointController::JointController(const JointControllerConfig& config) noexcept
    : config_(consistent(config)),
      shaper_(config.period_s),
      ordered_(config.period_s),
      observer_(observer_config(config)),
      landing_(landing_config(config)),
      rest_detector_(config.encoder_resolution_rad),
      motion_(config.motion) {
  assert(config.delay_samples >= 0 && config.delay_samples <= kMaxControlDelay);
  shaper_.set_limits(config.motion);
  ordered_.set_limits(config.motion);
}

void JointController::load(const GainTable& table) noexcept {
  if (gains_in_use_ != GainsInUse::kNone && !carry_over_) outgoing_ = active();
  carry_over_ = gains_in_use_ != GainsInUse::kNone;
  primary_ = ScheduledController(table.primary, table.friction, table.plant);
  fallback_ = ScheduledController(table.fallback, table.friction, table.plant);
  if (has_temperature_) primary_.set_temperature(temperature_C_);
  model_.inertia_kgm2 = table.plant.inertia_kgm2;
  model_.stribeck = {kStribeckShare * table.friction.velocity.zero_width_rad_s, kStribeckExponent};
  model_.friction = primary_.friction();
  torque_limit_Nm_ = std::min(table.torque_limit_Nm, config_.torque_limit_Nm);
  zero_velocity_weight_ = table.friction.velocity.zero_weight(0.0);
  has_table_ = true;
}

void JointController::start(double position_rad, double velocity_rad_s, double holding_torque_Nm) noexcept {
  motion_ = config_.motion;
  const double fastest = motion_.velocity_rad_s;
  const double begin_rad_s = std::clamp(velocity_rad_s, -fastest, fastest);
  shaper_.reset(position_rad, begin_rad_s);
  ordered_ = shaper_;
  observer_.reset(position_rad, velocity_rad_s, holding_torque_Nm);
  rest_detector_.reset();
  primary_.reset();
  fallback_.reset();
  torques_Nm_.fill(holding_torque_Nm);
  reference_ = {position_rad, begin_rad_s, 0.0};
  ordered_reference_ = reference_;
  previous_position_rad_ = position_rad;
  gains_in_use_ = GainsInUse::kNone;
  enter(MotionPhase::kTracking);
  plans_ = 0;
  replans_ = 0;
  begin_landings();
  landing_failures_ = 0;
  started_ = false;
  carry_over_ = false;
}

void JointController::set_target(double position_rad, double speed_limit_rad_s) noexcept {
  motion_ = config_.motion;
  if (speed_limit_rad_s > 0.0) motion_.velocity_rad_s = std::min(motion_.velocity_rad_s, speed_limit_rad_s);
  if (position_rad == shaper_.target_rad() && phase_ != MotionPhase::kTracking) return;
  shaper_.set_target(position_rad);
  ordered_.set_target(position_rad);
  plans_ = 0;
  begin_landings();
  enter(MotionPhase::kTracking);
}

void JointController::stop() noexcept {
  shaper_.stop();
  ordered_ = shaper_;
}

JointStep JointController::step(const JointMeasurement& measurement) noexcept {
  if (!has_table_) return {};
  const int elapsed_periods = std::clamp(measurement.elapsed_periods, 1, kMaxElapsedPeriods);
  choose_gains(measurement);
  estimate_state(measurement, elapsed_periods);
  look_ahead();
  advance_reference(elapsed_periods);
  choose_phase(measurement);
  const ControllerOutput output = compute_torque(measurement);
  remember(output.torque_Nm);
  JointStep result;
  result.output = output;
  result.reference = reference_;
  result.ordered_reference = ordered_reference_;
  result.joint_velocity_rad_s = then_.velocity_rad_s;
  result.gains_in_use = gains_in_use_;
  result.at_target = shaper_.at_target();
  result.phase = phase_;
  result.estimate = now_;
  result.replans = replans_;
  return result;
}

// Scheduled gains while the temperature is known, temperature-free ones otherwise. Friction stays that of the
// last temperature known.
void JointController::choose_gains(const JointMeasurement& measurement) noexcept {
  const GainsInUse wanted = measurement.temperature_valid ? GainsInUse::kPrimary : GainsInUse::kFallback;
  if (wanted != gains_in_use_) {
    if (gains_in_use_ != GainsInUse::kNone && !carry_over_) outgoing_ = active();
    carry_over_ = gains_in_use_ != GainsInUse::kNone;
    gains_in_use_ = wanted;
  }
  if (!measurement.temperature_valid) return;
  if (has_temperature_ && measurement.temperature_C == temperature_C_) return;
  primary_.set_temperature(measurement.temperature_C);
  model_.friction = primary_.friction();
  temperature_C_ = measurement.temperature_C;
  has_temperature_ = true;
}

// Over periods that were left out the last torque stayed applied: it is remembered once more for each.
void JointController::estimate_state(const JointMeasurement& measurement, int elapsed_periods) noexcept {
  const double position_rad = measurement.joint_position_rad;
  adapted_ = model_;
  for (int period = 0; started_ && period < elapsed_periods; ++period) {
    if (period > 0) push_back(torques_Nm_.front());
    if (config_.use_observer)
      observer_.predict(torques_Nm_[static_cast<std::size_t>(config_.delay_samples)], model_);
  }
  if (config_.use_observer) {
    if (measurement.has_velocity && config_.encoder_resolution_rad == 0.0)
      observer_.correct(position_rad, measurement.joint_velocity_rad_s);
    else
      observer_.correct(position_rad);
    now_ = observer_.estimate();
    adapted_.inertia_kgm2 *= now_.inertia_ratio;
  } else {
    now_ = {};
    now_.position_rad = position_rad;
    now_.velocity_rad_s = measurement.has_velocity ? measurement.joint_velocity_rad_s
                                                   : (position_rad - previous_position_rad_) /
                                                         (elapsed_periods * config_.period_s);
  }
  previous_position_rad_ = position_rad;
  started_ = true;
}

// The torques that are under way already decide the motion until this period's torque acts.
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

void JointController::advance_reference(int elapsed_periods) noexcept {
  if (!config_.use_shaping) {
    shaper_.jump();
    ordered_.jump();
    reference_ = {shaper_.target_rad(), 0.0, 0.0};
    ordered_reference_ = reference_;
    return;
  }
  for (int period = 0; period < elapsed_periods; ++period) {
    // The last of them begins anew, if one has to: it is where the joint is now.
    if (replan_ && period == elapsed_periods - 1) {
      const double fastest = config_.motion.velocity_rad_s;
      shaper_.restart(then_.position_rad, std::clamp(then_.velocity_rad_s, -fastest, fastest));
      ++replans_;
      replan_ = false;
    }
    reference_ = advanced(shaper_, reference_);
    ordered_reference_ = advanced(ordered_, ordered_reference_);
  }
}

// One period, within what the joint can do at the speed that the reference has reached.
Reference JointController::advanced(ReferenceShaper& shaper, const Reference& last) const noexcept {
  const double speed = std::abs(last.velocity_rad_s + config_.period_s * last.acceleration_rad_s2);
  shaper.set_limits(reachable_limits(motion_, config_.motor, adapted_, now_.disturbance, torque_limit_Nm_,
                                     config_.torque_reserve, speed, config_.period_s));
  return shaper.step();
}

bool JointController::reference_moves() const noexcept {
  return !shaper_.at_target() || reference_.velocity_rad_s != 0.0 || reference_.acceleration_rad_s2 != 0.0;
}

double JointController::distance_to_target_rad() const noexcept {
  return std::abs(then_.position_rad - shaper_.target_rad());
}

// How far one period's push, and one period's braking, can take the joint.
double JointController::landing_reach_rad() const noexcept {
  const double torque_Nm = kLandingShare * std::max(0.0, torque_limit_Nm_ - model_.friction.static_Nm);
  return torque_Nm * config_.period_s * config_.period_s / adapted_.inertia_kgm2;
}

bool JointController::landing_possible() const noexcept {
  const double reach_rad = landing_reach_rad();
  if (phase_ != MotionPhase::kTracking) return distance_to_target_rad() <= kLandingLost * reach_rad;
  return distance_to_target_rad() <= reach_rad &&
         std::abs(then_.velocity_rad_s) * config_.period_s <= reach_rad;
}

void JointController::choose_phase(const JointMeasurement& measurement) noexcept {
  if (!config_.use_rest || reference_moves()) return enter(MotionPhase::kTracking);
  if (!landing_works()) {
    if (++landing_pause_ >= kLandingPause) begin_landings();
    const double distance_rad = measurement.joint_position_rad - shaper_.target_rad();
    const bool resting = rest_detector_.update(distance_rad, now_.velocity_rad_s);
    return enter(resting ? MotionPhase::kResting : MotionPhase::kTracking);
  }
  if (!landing_possible()) {
    ask_for_new_plan();
    return enter(MotionPhase::kTracking);
  }
  const double count_rad = std::max(config_.encoder_resolution_rad, kExactRestWindow_rad);
  const bool away = phase_ == MotionPhase::kResting && distance_to_target_rad() > count_rad;
  away_periods_ = away ? away_periods_ + 1 : 0;
  if (phase_ == MotionPhase::kTracking || away_periods_ >= kLeavePeriods) enter(MotionPhase::kLanding);
}

void JointController::begin_landings() noexcept {
  landing_periods_ = 0;
  landing_begins_ = 0;
  landing_pause_ = 0;
}

bool JointController::landing_works() const noexcept {
  return config_.use_landing && landing_periods_ < kLandingPeriods && landing_begins_ <= kLandingBegins &&
         landing_failures_ < kLandingFailures;
}

void JointController::enter(MotionPhase phase) noexcept {
  if (phase == MotionPhase::kTracking && reference_moves()) rest_detector_.reset();
  if (phase == phase_) return;
  // What the integral knew of load and friction, the observer knows.
  if (phase_ == MotionPhase::kLanding) active().reset();
  if (phase == MotionPhase::kLanding) {
    landing_.begin(shaper_.target_rad());
    if (++landing_begins_ > kLandingBegins) ++landing_failures_;
  }
  plans_ = 0;
  hold_torque_Nm_ = now_.disturbance.load_Nm + active().integral_torque_Nm();
  phase_ = phase;
}

void JointController::ask_for_new_plan() noexcept {
  if (!config_.use_shaping || plans_ >= kPlanLimit) return;
  ++plans_;
  replan_ = true;
}

ControllerOutput JointController::compute_torque(const JointMeasurement& measurement) noexcept {
  if (phase_ == MotionPhase::kTracking) return track();
  carry_over_ = false;
  if (phase_ == MotionPhase::kResting) return apply(hold_torque_Nm_);
  const double torque_Nm = landing_.step(now_, then_, measurement.joint_position_rad, adapted_);
  if (++landing_periods_ == kLandingPeriods) ++landing_failures_;
  if (landing_.resting()) {
    begin_landings();
    landing_failures_ = 0;
    enter(MotionPhase::kResting);
  }
  return apply(torque_Nm);
}

// Inertia at the reference's acceleration, friction at its speed in the middle of the period, load.
double JointController::planned_torque_Nm() const noexcept {
  const double velocity = reference_.velocity_rad_s + 0.5 * config_.period_s * reference_.acceleration_rad_s2;
  const double friction_Nm =
      std::max(0.0, adapted_.friction_Nm(velocity) + now_.disturbance.friction_offset_Nm);
  return adapted_.inertia_kgm2 * reference_.acceleration_rad_s2 + sign(velocity) * friction_Nm +
         now_.disturbance.load_Nm;
}

ControllerOutput JointController::track() noexcept {
  ControllerInput input;
  input.joint_position_rad = then_.position_rad;
  input.joint_velocity_rad_s = then_.velocity_rad_s;
  input.setpoint_position_rad = reference_.position_rad;
  input.setpoint_velocity_rad_s = reference_.velocity_rad_s;
  input.planned = reference_.velocity_rad_s != 0.0 || reference_.acceleration_rad_s2 != 0.0;
  input.planned_torque_Nm = input.planned ? planned_torque_Nm() : now_.disturbance.load_Nm;
  if (config_.use_rest) input.rest_zone_rad = std::max(input.rest_zone_rad, config_.encoder_resolution_rad);
  input.torque_limit_Nm = torque_limit_Nm_;
  input.torque_max_Nm = config_.motor.available_Nm(then_.velocity_rad_s);
  input.torque_min_Nm = -config_.motor.available_Nm(-then_.velocity_rad_s);
  if (carry_over_) active().carry_over(input, outgoing_.step(input).torque_Nm);
  carry_over_ = false;
  const ControllerOutput output = active().step(input);

  const double behind_rad = std::abs(then_.position_rad - reference_.position_rad);
  if (config_.use_observer && output.saturated && behind_rad > kReplanPushes * landing_reach_rad())
    ask_for_new_plan();
  return output;
}

// A torque that no gain has part in.
ControllerOutput JointController::apply(double torque_Nm) const noexcept {
  const double limited_Nm = std::clamp(torque_Nm, -torque_limit_Nm_, torque_limit_Nm_);
  return {limited_Nm, 0.0, torque_Nm, zero_velocity_weight_, limited_Nm != torque_Nm};
}

void JointController::remember(double torque_Nm) noexcept {
  push_back(config_.motor.limit_Nm(torque_Nm, then_.velocity_rad_s));
}

void JointController::push_back(double torque_Nm) noexcept {
  std::copy_backward(torques_Nm_.begin(), torques_Nm_.end() - 1, torques_Nm_.end());
  torques_Nm_.front() = torque_Nm;
}

}  // namespace strainwave
