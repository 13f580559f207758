#include "control/joint_controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "control/link_velocity.h"
#include "control/units.h"

namespace strainwave {

namespace {

// The Stribeck velocity as a share of the width of the table's "zero velocity" membership, and its exponent.
constexpr double kStribeckShare = 0.5;
constexpr double kStribeckExponent = 2.0;
// Farther than this from the stream, a joint is off it: a tenth of a count of a fine encoder.
constexpr double kOnStream_rad = 2e-6;
// A joint without friction has none to estimate; what is estimated needs a scale all the same.
constexpr double kLeastFrictionShare = 1e-4;  // of the torque limit
// Way over which friction is taken to come up again once a stream has turned round: what is streamed may flicker by a count, as it is
// some encoder's reading.
constexpr double kTurnCounts = 2.0;

// Over the mean of this time the acceleration of an eased move is spread. It takes free swings of 50 Hz away; of the catalogue's joints,
// which swing at 28 to 86 Hz, it leaves half of the slowest and a seventh of the fastest.
constexpr double kEasing_s = 0.02;

/// Of a velocity by readings.
double velocity_share(const JointControllerConfig& config) noexcept {
  return config.link ? velocity_share(config.encoder_side, config.period_s) : 1.0;
}

StateEstimatorConfig estimator_config(const JointControllerConfig& config) noexcept {
  StateEstimatorConfig estimator;
  estimator.observer.period_s = config.period_s;
  estimator.observer.encoder_resolution_rad = config.encoder_resolution_rad;
  estimator.observer.edge_deviation_counts = config.encoder_deviation_counts;
  estimator.observer.sampling_deviation_s = config.sampling_deviation_s;
  estimator.delay_periods = config.delay_periods;
  estimator.velocity_share = velocity_share(config);
  estimator.current_loop_s = config.current_loop_s.value_or(0.0);
  return estimator;
}

LandingConfig landing_config(const JointControllerConfig& config) noexcept {
  LandingConfig landing;
  landing.period_s = config.period_s;
  landing.encoder_resolution_rad = config.encoder_resolution_rad;
  landing.delay_periods = config.delay_periods;
  return landing;
}

// What the reference may do, so that its jerk can be kept.
MotionLimits motion_limits(const JointControllerConfig& config) noexcept {
  if (!config.jerk_limit_rad_s3) return config.motion;
  return JerkLimit::possible(config.motion, *config.jerk_limit_rad_s3, config.period_s);
}

// The model's motor is at the encoder.
bool follows_model(const JointControllerConfig& config) noexcept {
  return config.link && config.encoder_side == EncoderSide::kMotor;
}

ReferencePlan plan_for(const JointControllerConfig& config) noexcept {
  if (config.use_shaping && config.jerk_limit_rad_s3)
    return ReferencePlan::limited(
        config.period_s, JerkLimit(motion_limits(config), *config.jerk_limit_rad_s3, config.period_s));
  const JerkLimit easing = JerkLimit::spread_over(kEasing_s, config.period_s);
  if (config.use_shaping && follows_model(config))
    return ReferencePlan::plain_until_eased(config.period_s, easing);
  if (config.use_shaping && !config.rigid) return ReferencePlan::eased(config.period_s, easing);
  return ReferencePlan::plain(config.period_s);
}

LinkMotionConfig link_config(const JointControllerConfig& config) noexcept {
  LinkMotionConfig link;
  link.period_s = config.period_s;
  link.joint = *config.link;
  link.joint.gravity = config.gravity;
  link.tolerance_rad = 0.5 * std::max(config.encoder_resolution_rad, kExactRestWindow_rad);
  link.torque_limit_Nm = config.torque_limit_Nm;
  link.delay_periods = config.delay_periods;
  return link;
}

}  // namespace

JointController::JointController(const JointControllerConfig& config) noexcept
    : config_(config),
      plan_(plan_for(config)),
      ordered_(plan_),
      stream_(config.period_s, config.stream_bridge_s),
      state_(estimator_config(config)),
      current_loop_(config.current_loop_s.value_or(0.0), config.period_s),
      landing_(landing_config(config)),
      corrections_(config.period_s, count_rad()),
      swing_side_(config.period_s),
      monitor_(config.period_s),
      friction_side_(kTurnCounts * count_rad()),
      rest_detector_(config.encoder_resolution_rad),
      law_(config.period_s, config.encoder_resolution_rad, velocity_share(config), config.link.has_value()),
      handover_(config.period_s),
      motion_(motion_limits(config)) {
  config_.motion = motion_;
  assert(!config.use_landing || (config.rigid && config.use_observer && config.use_rest));
  assert(!config.link || (config.use_shaping && !config.rigid));
  assert(config.gravity.torque_Nm == 0.0 || !config.use_observer);
  assert(!config.current_loop_s || config.use_observer);
  if (follows_model(config)) link_motion_.emplace(link_config(config));
  plan_.set_limits(motion_);
  ordered_.set_limits(motion_);
}

void JointController::load(const GainTable& table) noexcept {
  law_.load(table);
  model_.inertia_kgm2 = config_.link ? config_.link->motor_inertia_kgm2 + config_.link->link_inertia_kgm2
                                     : table.plant.inertia_kgm2;
  model_.stribeck = {kStribeckShare * table.friction.velocity.zero_width_rad_s, kStribeckExponent};
  model_.friction = law_.friction();
  torque_limit_Nm_ = config_.torque_limit_with(table);
  table_limit_Nm_ = table.torque_limit_Nm;
  model_.friction_scale_Nm =
      std::max(table.friction.least_static_Nm(), kLeastFrictionShare * torque_limit_Nm_);
}

void JointController::start(double position_rad, double velocity_rad_s,
                            std::optional<double> holding_torque_Nm) noexcept {
  motion_ = config_.motion;
  const double fastest = motion_.velocity_rad_s;
  const double begin_rad_s = std::clamp(velocity_rad_s, -fastest, fastest);
  const double planned_rad = link_motion_ ? link_motion_->reset(position_rad, begin_rad_s) : position_rad;
  plan_.begin(planned_rad, begin_rad_s);
  ordered_ = plan_;
  const double gravity_Nm = config_.gravity.at(position_rad);
  state_.reset(position_rad, velocity_rad_s, holding_torque_Nm.value_or(gravity_Nm) - gravity_Nm,
               model_.friction_scale_Nm);
  rest_detector_.reset();
  law_.begin_anew();
  reference_ = {position_rad, begin_rad_s, 0.0};
  ordered_reference_ = reference_;
  setpoint_velocity_rad_s_ = begin_rad_s;
  planned_ = {0.0, begin_rad_s, 0.0};
  motor_plan_ = {};
  link_share_ = 1.0;
  corrections_.reset();
  enter(MotionPhase::kTracking);
  new_plans_.reset();
  replans_ = 0;
  attempts_.reset();
  monitor_.reset();
  // Nobody has ordered a motion: what stands is left alone, its last counts as well.
  if (config_.use_rest && velocity_rad_s == 0.0 && may_land()) {
    enter(MotionPhase::kResting);
    stands_ = true;
  }
  hold_torque_Nm_ = holding_torque_Nm.value_or(gravity_Nm);
  handover_.reset();
  reference_rest_s_ = 0.0;
  corrects_ = false;
  follows_ = Follows::kTarget;
  told_load_ = {};
  shown_load_Nm_ = state_.now().disturbance.load_Nm;
}

void JointController::limit_speed(double speed_limit_rad_s) noexcept {
  motion_ = config_.motion;
  if (speed_limit_rad_s > 0.0) motion_.velocity_rad_s = std::min(motion_.velocity_rad_s, speed_limit_rad_s);
}

void JointController::new_target() noexcept {
  link_share_ = 1.0;
  corrects_ = false;
  attempts_.new_target();
  enter(MotionPhase::kTracking);
}

void JointController::set_target(double position_rad, double speed_limit_rad_s) noexcept {
  limit_speed(speed_limit_rad_s);
  const bool same_target = position_rad == plan_.target_rad();
  const bool repeated = same_target && !streamed();
  follows_ = Follows::kTarget;
  if (same_target && phase_ != MotionPhase::kTracking) return;
  ease();
  plan_.set_target(position_rad);
  ordered_.set_target(position_rad);
  new_plans_.new_order();
  if (repeated)
    corrections_.trust_anew();
  else
    corrections_.reset();
  new_target();
  if (link_motion_) plan_link_motion(reference_.position_rad);
}

void JointController::stop() noexcept {
  follows_ = Follows::kTarget;
  plan_.stop();
  ordered_ = plan_;
}

JointStep JointController::step(const JointMeasurement& measurement) noexcept {
  if (!has_table()) return {};
  const int elapsed_periods = std::clamp(measurement.elapsed_periods, 1, kMaxElapsedPeriods);
  signs_ = {};
  choose_gains(measurement);
  // Of the motion until now: a plan's, or a push that ends on the target.
  const bool planned =
      phase_ == MotionPhase::kLanding || (phase_ == MotionPhase::kTracking && torque_is_planned());
  const SurpriseCause by_friction =
      follows_ == Follows::kTarget ? SurpriseCause::kFriction : SurpriseCause::kFollowedFriction;
  state_.step(measurement, loaded_model(), estimate_source(), planned ? by_friction : SurpriseCause::kLoad);
  // Of a stall over which nobody knows what the joint did begin_period() has been told.
  const bool missed = measurement.elapsed_periods > kMaxElapsedPeriods;
  if (yields())
    go_on_yielding(elapsed_periods);
  else if (!missed || !goes_on_anew())
    advance_reference(missed ? 1 : elapsed_periods);
  setpoint_velocity_rad_s_ =
      smoothed(setpoint_velocity_rad_s_, reference_.velocity_rad_s, state_.velocity_share(), elapsed_periods);
  follow_friction(elapsed_periods);
  if (!yields()) choose_phase(measurement);
  follow_disturbance(elapsed_periods);
  ControllerOutput output = compute_torque(measurement);
  ease_answer(output, elapsed_periods);
  hand_over(output);
  // What is told of the load is not estimated.
  state_.remember(config_.motor.limit_Nm(output.torque_Nm, state_.then().velocity_rad_s) -
                  told_load_.torque_Nm);
  watch(output, elapsed_periods);
  weigh(output, elapsed_periods);
  JointStep result;
  result.output = output;
  result.reference = reference_;
  result.ordered_reference = ordered_reference_;
  result.joint_velocity_rad_s = state_.then().velocity_rad_s;
  result.gains_in_use = law_.gains_in_use();
  result.at_target = plan_.rests() && !(linked() && link_motion_->moves());
  result.off_stream =
      streamed() && !corrects_ && std::abs(plan_.target_rad() - plan_.position_rad()) > kOnStream_rad;
  result.phase = phase_;
  result.estimate = state_.now();
  result.load_Nm = shown_load_Nm_;
  result.replans = replans_;
  result.monitor = monitor_.state();
  return result;
}

void JointController::choose_gains(const JointMeasurement& measurement) noexcept {
  std::optional<double> temperature_C;
  if (measurement.temperature_valid) temperature_C = measurement.temperature_C;
  law_.choose_gains(temperature_C);
  model_.friction = law_.friction();
}

JointModel JointController::loaded_model() const noexcept {
  JointModel model = model_;
  model.inertia_kgm2 += told_load_.inertia_kgm2;
  return model;
}

}  // namespace strainwave
