// What JointController does each period once it knows where the joint and its reference are: the phase of the
// motion, its torque, and the watch over both.
#include <algorithm>
#include <cmath>

#include "control/joint_controller.h"
#include "control/units.h"

namespace strainwave {

namespace {

// Landing begins where one push with this share of the torque that the table allows, and one period's braking, can end on the target. A lower
// limit of the joint's own makes several of it: near its friction hardly a count, and each that it is off would ask for a new plan.
constexpr double kLandingShare = 0.5;
// A landing that finds itself this many times farther away is given up: something pushed the joint.
constexpr double kLandingLost = 4.0;
// A saturated joint that is farther behind than this many such pushes needs a new plan.
constexpr double kReplanPushes = 4.0;
// On a joint that is not declared rigid friction is compensated towards the target for so long after the
// reference has come to rest, and longer only farther away than so many counts: one push makes some of them.
constexpr double kHunting_s = 0.1;
constexpr double kHuntingCounts = 20.0;
// What swings less than the counts above at the catalogue's encoder does so by the give of its gear, however fine the encoder: a hand or a
// tap makes it.
constexpr double kLeastSwing_rad = 4e-4;
// Share of the torque limit that the feedback may answer with while a motion lasts, where spring, damping and load are not quite as
// told. A joint that chatters uses more of it.
constexpr double kSpringDoubt = 0.2;
// Share of the table's torque limit by which what a stream feeds forward against friction and load changes each period, however small the change.
constexpr double kLeastChange = 0.006;
// The same on a path, which is known to its end: it waits for no sample that could tell of a load.
constexpr double kLeastChangeOnPath = 0.003;
// The same of all that readings have changed of a rigid joint's torque since the last period, feedback included, and by how many times as much
// it may be off before it changes by twice as much.
constexpr double kLeastAnswer = 0.0175;
constexpr double kAnswersTwice = 8.0;
// Periods that a resting joint must be off its target before it moves again: a count may flicker.
constexpr int kLeavePeriods = 3;
// Counts by which the reading of a joint that stands as it was found may flicker. What is farther leaves the rest at once.
constexpr double kStandingFlickerCounts = 1.5;

}  // namespace

bool JointController::reference_moves() const noexcept {
  if (linked()) return !plan_.rests() || link_motion_->moves();
  return !plan_.rests() || reference_.velocity_rad_s != 0.0 || reference_.acceleration_rad_s2 != 0.0;
}

EstimateSource JointController::estimate_source() const noexcept {
  if (observing()) return EstimateSource::kObserver;
  return reference_rest_s_ > kHunting_s ? EstimateSource::kReadingsAtRest : EstimateSource::kReadings;
}

double JointController::distance_to_target_rad() const noexcept {
  return std::abs(state_.then().position_rad - plan_.target_rad());
}

// How far one period's push, and one period's braking, can take the joint, but for its own torque limit.
double JointController::landing_reach_rad() const noexcept {
  const double torque_Nm = kLandingShare * std::max(0.0, table_limit_Nm_ - model_.friction.static_Nm);
  return torque_Nm * config_.period_s * config_.period_s / state_.model().inertia_kgm2;
}

bool JointController::landing_possible() const noexcept {
  const double reach_rad = landing_reach_rad();
  if (phase_ != MotionPhase::kTracking) return distance_to_target_rad() <= kLandingLost * reach_rad;
  return distance_to_target_rad() <= reach_rad &&
         std::abs(state_.then().velocity_rad_s) * config_.period_s <= reach_rad;
}

void JointController::choose_phase(const JointMeasurement& measurement) noexcept {
  if (!config_.use_rest || reference_moves()) return enter(MotionPhase::kTracking);
  // A path that turns goes on: a push to the very count would only be in its way.
  if (phase_ == MotionPhase::kTracking && turns()) return;
  if (linked() && correct_link(measurement.joint_position_rad)) return enter(MotionPhase::kTracking);
  if (!may_land()) {
    attempts_.wait();
    const double distance_rad = measurement.joint_position_rad - rest_position_rad();
    const bool resting = rest_detector_.update(distance_rad, state_.now().velocity_rad_s);
    return enter(resting ? MotionPhase::kResting : MotionPhase::kTracking);
  }
  // By a load, once no brake holds it any more.
  const double shown_rad = std::abs(measurement.joint_position_rad - plan_.target_rad());
  const bool taken = stands_ && shown_rad > kStandingFlickerCounts * count_rad();
  if (stands_ && !taken) return;
  // A push that is planned to its end has become another over periods that were left out.
  const bool planned = config_.delay_periods > 1;
  if (phase_ == MotionPhase::kLanding && planned && measurement.elapsed_periods > 1)
    enter(MotionPhase::kTracking);
  if (!landing_possible()) {
    ask_for_new_plan();
    return enter(MotionPhase::kTracking);
  }
  const bool away = phase_ == MotionPhase::kResting && distance_to_target_rad() > count_rad();
  away_periods_ = away ? away_periods_ + 1 : 0;
  if (phase_ == MotionPhase::kTracking || away_periods_ >= kLeavePeriods || taken)
    enter(MotionPhase::kLanding);
}

void JointController::enter(MotionPhase phase) noexcept {
  if (phase == MotionPhase::kTracking && reference_moves()) {
    rest_detector_.reset();
    corrections_.motion();
  }
  if (phase == phase_) return;
  stands_ = false;
  // What the integral knew of load and friction, the observer knows.
  if (phase_ == MotionPhase::kLanding) law_.forget_integral();
  if (phase == MotionPhase::kLanding) {
    landing_.begin(plan_.target_rad());
    attempts_.begin();
  }
  new_plans_.new_phase();
  hold_torque_Nm_ = estimated_load_Nm() + law_.integral_torque_Nm();
  phase_ = phase;
}

void JointController::ask_for_new_plan() noexcept {
  if (config_.rigid && !fallen_back() && config_.use_shaping) new_plans_.ask();
}

ControllerOutput JointController::compute_torque(const JointMeasurement& measurement) noexcept {
  if (phase_ == MotionPhase::kTracking) return track(measurement.elapsed_periods);
  law_.interrupt();
  if (phase_ == MotionPhase::kYielding)
    return apply(yielding_.load_Nm + config_.gravity.at(state_.now().position_rad) + told_load_.torque_Nm);
  if (phase_ == MotionPhase::kResting) return apply(hold_torque_Nm_ + told_load_.torque_Nm);
  const double torque_Nm =
      landing_.step(state_.now(), state_.then(), measurement.joint_position_rad, state_.model());
  attempts_.spend_period();
  if (landing_.resting()) {
    attempts_.landed();
    enter(MotionPhase::kResting);
  }
  // What a push is planned with is its period's mean.
  return apply(current_loop_.command_Nm(torque_Nm, state_.acting_then_Nm()) + told_load_.torque_Nm);
}

double JointController::estimated_load_Nm() const noexcept {
  return state_.now().disturbance.load_Nm + config_.gravity.at(state_.now().position_rad);
}

double JointController::held_load_Nm() const noexcept {
  return estimated_load_Nm() + told_load_.torque_Nm;
}

// In the middle of the period over which the torque of now will act.
double JointController::planned_velocity_rad_s() const noexcept {
  return linked() ? motor_plan_.acting_velocities_rad_s[1]
                  : reference_.velocity_rad_s + 0.5 * config_.period_s * reference_.acceleration_rad_s2;
}

// Where a plan turns round it goes on.
void JointController::follow_friction(int elapsed_periods) noexcept {
  if (may_dither() && torque_is_planned())
    friction_side_.move(elapsed_periods * config_.period_s * planned_velocity_rad_s(),
                        stream_.way_ahead_rad());
  else
    friction_side_.reset();
}

void JointController::follow_disturbance(int elapsed_periods) noexcept {
  const JointDisturbance& estimated = state_.now().disturbance;
  if (!streamed() || phase_ != MotionPhase::kTracking || !torque_is_planned())
    return disturbance_.jump_to(estimated);
  const double count_Nm = state_.model().inertia_kgm2 * count_rad() / (config_.period_s * config_.period_s);
  const double least = follows_ == Follows::kStreamOnTime ? kLeastChange : kLeastChangeOnPath;
  disturbance_.follow(estimated, least * table_limit_Nm_, count_Nm, elapsed_periods);
}

double JointController::planned_friction_Nm(const JointDisturbance& disturbance) const noexcept {
  // What is less than all of it is that of a dither.
  const bool shared = may_dither() && std::abs(friction_side_.share()) < 1.0;
  if (linked()) {
    const auto [begin, middle, end] = motor_plan_.acting_velocities_rad_s;
    const double friction_Nm =
        0.5 * (1.0 + corrections_.friction_doubt()) *
        (state_.model().friction_along_Nm(begin, middle) + state_.model().friction_along_Nm(middle, end));
    return shared ? friction_side_.share() * std::abs(friction_Nm) : friction_Nm;
  }
  // Of friction that turned out to be more than the joint has, nothing is believed.
  if (monitor_.drives_itself()) return 0.0;
  const double velocity = planned_velocity_rad_s();
  const double friction_Nm =
      std::max(0.0, state_.model().friction_Nm(velocity) + disturbance.friction_offset_Nm);
  return (shared ? friction_side_.share() : sign(velocity)) * friction_Nm;
}

// Inertia at the reference's acceleration, friction, load.
double JointController::planned_torque_Nm(const JointDisturbance& disturbance) const noexcept {
  if (linked())
    return motor_plan_.torque_Nm + planned_friction_Nm(disturbance) + disturbance.load_Nm +
           told_load_.torque_Nm + told_load_.inertia_kgm2 * motor_plan_.wanted_acceleration_rad_s2;
  return state_.model().inertia_kgm2 * reference_.acceleration_rad_s2 + planned_friction_Nm(disturbance) +
         disturbance.load_Nm + config_.gravity.at(reference_.position_rad) + told_load_.torque_Nm;
}

ControllerOutput JointController::track(int elapsed_periods) noexcept {
  ControllerInput input;
  input.elapsed_periods = elapsed_periods;
  input.joint_position_rad = state_.then().position_rad;
  input.joint_velocity_rad_s = state_.then().velocity_rad_s;
  input.setpoint_position_rad = reference_.position_rad;
  input.setpoint_velocity_rad_s = setpoint_velocity_rad_s_;
  // Static friction pushed towards the target from either side hunts for the last counts, and a spring turns that
  // into an oscillation: what has not come off soon after the reference, and the fallback, leave them to the integral.
  const bool moves = torque_is_planned();
  // Where a path turns nothing is pushed: the joint stands by its friction until it goes on.
  const bool stands = !moves && turns();
  reference_rest_s_ = moves ? 0.0 : reference_rest_s_ + config_.period_s;
  const double near_rad = kHuntingCounts * count_rad();
  const double off_rad = state_.then().position_rad - reference_.position_rad;
  hunted_ = !config_.rigid && reference_rest_s_ > kHunting_s && std::abs(off_rad) <= near_rad;
  signs_.swung_over = swing_side_.swings_over(off_rad, std::max(near_rad, kLeastSwing_rad));
  input.planned = moves || stands || fallen_back() || hunted_ || linked();
  // At rest a landing holds the load of a rigid joint.
  const bool landed = config_.rigid && !stands && !fallen_back();
  const double at_rest_Nm = landed ? told_load_.torque_Nm : held_load_Nm();
  input.planned_torque_Nm = moves ? planned_torque_Nm(disturbance_.value()) : at_rest_Nm;
  if (config_.use_rest) input.rest_zone_rad = std::max(input.rest_zone_rad, config_.encoder_resolution_rad);
  input.torque_limit_Nm = torque_limit_Nm_;
  input.torque_max_Nm = config_.motor.available_Nm(state_.then().velocity_rad_s);
  input.torque_min_Nm = -config_.motor.available_Nm(-state_.then().velocity_rad_s);
  const ControllerOutput output = law_.step(input);

  if (observing() && output.saturated && std::abs(off_rad) > kReplanPushes * landing_reach_rad())
    ask_for_new_plan();
  return output;
}

// A count, where the joint turns round and breaks away, shifts feedback and disturbance alike, by newton metres, and the turn of the motion turns
// what is estimated of friction: more steps than the motion asks for. What the plan itself needs of the model has none of it, and what pushes a
// joint at rest is no answer to a reading: a motion that begins amid a push would have it on top of its own friction.
void JointController::ease_answer(ControllerOutput& output, int elapsed_periods) noexcept {
  if (!config_.rigid) return;
  const bool planned = phase_ == MotionPhase::kTracking && torque_is_planned();
  const double by_model_Nm = planned ? planned_torque_Nm({}) : 0.0;
  if (!planned && observing()) return answer_.jump_to(state_.now().disturbance.load_Nm);
  if (!planned || !streamed() || fallen_back()) return answer_.jump_to(output.torque_Nm - by_model_Nm);
  const double least_Nm = kLeastAnswer * table_limit_Nm_;
  answer_.follow(output.feedback_torque_Nm + output.feedforward_torque_Nm - by_model_Nm, least_Nm,
                 kAnswersTwice * least_Nm, elapsed_periods);
  const double wanted_Nm = by_model_Nm + answer_.value_Nm();
  output.feedback_torque_Nm = wanted_Nm - output.feedforward_torque_Nm;
  output.torque_Nm = std::clamp(config_.motor.limit_Nm(wanted_Nm, state_.then().velocity_rad_s),
                                -torque_limit_Nm_, torque_limit_Nm_);
}

// The fallback begins with the torque that was applied last.
void JointController::hand_over(ControllerOutput& output) noexcept {
  if (!fallen_back()) return;
  output.torque_Nm = std::clamp(handover_.torque_Nm(output.torque_Nm), -torque_limit_Nm_, torque_limit_Nm_);
}

void JointController::watch(const ControllerOutput& output, int elapsed_periods) noexcept {
  if (!config_.use_monitor) return;
  const bool moves = torque_is_planned();
  const double needed_Nm = config_.motor.limit_Nm(
      moves ? planned_torque_Nm(disturbance_.value()) : held_load_Nm(), state_.then().velocity_rad_s);
  ChatterSample sample;
  sample.torque_Nm = output.torque_Nm;
  sample.planned_torque_Nm = std::clamp(needed_Nm, -torque_limit_Nm_, torque_limit_Nm_);
  sample.doubt_Nm = linked() && moves ? kSpringDoubt * torque_limit_Nm_ : 0.0;
  if (streamed() && !config_.rigid && !linked())
    sample.ordered_torque_Nm =
        state_.model().inertia_kgm2 * reference_.acceleration_rad_s2 + told_load_.torque_Nm;
  sample.static_friction_Nm = model_.friction.static_Nm;
  sample.feedback_step_Nm = law_.count_torque_Nm(observing());
  sample.torque_limit_Nm = torque_limit_Nm_;
  sample.compensates_friction = !linked() && !fallen_back() && !hunted_;
  sample.follows_model = linked();
  if (linked()) sample.innovation_Nm = output.feedback_torque_Nm;
  sample.reference_rests = !moves;
  sample.swung_over = signs_.swung_over;
  sample.turned_back = signs_.turned_back;
  sample.landing = phase_ == MotionPhase::kLanding;
  sample.surprised = state_.now().surprised;
  sample.elapsed_periods = elapsed_periods;
  const bool watched = !fallen_back();
  const bool goes_on = moves && !corrections_.begun();
  const MonitorState state = monitor_.step(sample);
  corrections_.distrust(monitor_.distrust());
  if (watched && state != MonitorState::kWatching) {
    handover_.begin(output.torque_Nm, goes_on);
    if (link_motion_) go_on_from_here();
  } else if (!watched && monitor_.goes_on() && !law_.soft()) {
    // What swings is a motion: a push that is undone would swing it on.
    handover_.begin(output.torque_Nm, true);
    law_.soften();
  }
}

// A torque that no gain has part in.
ControllerOutput JointController::apply(double torque_Nm) const noexcept {
  const double limited_Nm = std::clamp(torque_Nm, -torque_limit_Nm_, torque_limit_Nm_);
  return {limited_Nm, 0.0, torque_Nm, law_.zero_velocity_weight(), limited_Nm != torque_Nm};
}

}  // namespace strainwave
