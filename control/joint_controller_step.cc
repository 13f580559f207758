// The steps of JointController's period, in their order.
#include <algorithm>
#include <cmath>

#include "control/joint_controller.h"
#include "control/units.h"

namespace strainwave {

namespace {

// While a motion speeds up and the torque is limited its accelerations fall by 1/e in this time, down to the least share. With a load that is
// 30 % heavier than configured, 1 rad at full torque, the link overshoots by 9 mrad; without it by 97 (`strainwave-sim flexible --wrong`).
constexpr double kPace_s = 0.2;
constexpr double kLeastPace = 0.3;
// A reading at its place may be off by one count, and by rounding.
constexpr double kAtPlaceCounts = 1.01;
// A plan that has ended is held from then on.
constexpr int kSettlingPeriods = 2;
// Of the load that shows: longer than a count's torque lasts.
constexpr double kWeigh_s = 0.01;
// So long a joint that was pushed stands before it is brought to rest; within so many counts it stands.
constexpr double kStands_s = 0.02;
constexpr double kStandsCounts = 3.0;
// Smaller swings of the feedback are no oscillation: a share of the torque limit, and what a count makes of the law.
constexpr double kSwingShare = 0.2;
constexpr double kSwingCounts = 2.0;

}  // namespace

void JointController::choose_gains(const JointMeasurement& measurement) noexcept {
  std::optional<double> temperature_C;
  if (measurement.temperature_valid) temperature_C = measurement.temperature_C;
  if (law_.choose_gains(temperature_C)) friction_.weigh(law_.temperature_weights());
}

// A motion over a gap in which the loop did not run: it goes on from where the joint is.
void JointController::go_on_from(const JointMeasurement& measurement) noexcept {
  const double passed_s = measurement.elapsed_periods * config_.period_s;
  const bool seen = measurement.has_position;
  const double position_rad = seen ? measurement.joint_position_rad : reading_.position_rad();
  const double shown_rad_s = seen ? (position_rad - reading_.position_rad()) / passed_s : 0.0;
  const double fastest = config_.motion.velocity_rad_s;
  const double velocity_rad_s = std::clamp(shown_rad_s, -fastest, fastest);
  law_.reference_jumps();
  trajectory_.go_on_from(begin_plan(position_rad, velocity_rad_s), velocity_rad_s);
  reading_.reset(position_rad, velocity_rad_s);
}

// What the joint can do at the speed that the reference has reached.
MotionLimits JointController::present_limits() const noexcept {
  const ToldLoad& load = trajectory_.load();
  const double load_Nm = config_.gravity.at(plan_.link_position_rad) + load.torque_Nm + friction_.load_Nm();
  MotionLimits limits =
      reachable_limits(motion_, config_.motor, loaded_model(), load_Nm, torque_limit_Nm_,
                       config_.torque_reserve, std::abs(trajectory_.velocity_rad_s()), config_.period_s);
  limits.acceleration_rad_s2 *= pace_;
  limits.deceleration_rad_s2 *= pace_;
  return limits;
}

void JointController::advance_plan(int elapsed_periods) noexcept {
  for (int period = 0; period < elapsed_periods; ++period) {
    const double last_target_rad = trajectory_.present_target_rad();
    const Reference planned = trajectory_.step(present_limits());
    keep_load();
    if (trajectory_.streamed() && trajectory_.present_target_rad() != last_target_rad) corrections_.reset();
    speeds_up_ = planned.velocity_rad_s * planned.acceleration_rad_s2 > 0.0;
    const ToldLoad& load = trajectory_.load();
    const double speed_rad_s = plan_.acting_velocities_rad_s.back();
    const double taken_Nm = sign(speed_rad_s) * loaded_model().friction_Nm(speed_rad_s) +
                            friction_.load_Nm() + load.torque_Nm +
                            load.inertia_kgm2 * plan_.wanted_acceleration_rad_s2;
    const auto available_Nm = [&](double along_rad_s) {
      return std::min(torque_limit_Nm_, config_.motor.available_Nm(along_rad_s));
    };
    plan_ = planner_.step(
        planned, {-available_Nm(-speed_rad_s) - taken_Nm, available_Nm(speed_rad_s) - taken_Nm}, taken_Nm);
  }
}

void JointController::read(const JointMeasurement& measurement) noexcept {
  if (yields()) return reading_.step(measurement, plan_.position_rad, plan_.position_rad);
  const LinkState now = planner_.before(0);
  const LinkState then = planner_.before(std::clamp(measurement.late_periods, 0, kMaxControlDelay));
  if (config_.encoder_side == EncoderSide::kLink)
    reading_.step(measurement, now.link_position_rad, then.link_position_rad);
  else
    reading_.step(measurement, now.motor_position_rad, then.motor_position_rad);
}

double JointController::place_rad() const noexcept {
  return config_.encoder_side == EncoderSide::kLink ? plan_.link_position_rad : plan_.position_rad;
}

bool JointController::moves() const noexcept {
  return planner_.moves() || !trajectory_.rests();
}

void JointController::choose_phase() noexcept {
  if (moves()) {
    corrections_.motion();
    rest_periods_ = 0;
    phase_ = MotionPhase::kTracking;
    return;
  }
  ++rest_periods_;
  const double off_rad = place_rad() - reading_.position_rad();
  const bool at_place = std::abs(off_rad) <= kAtPlaceCounts * count_rad();
  if (corrections_.begins(off_rad, reading_.still_periods())) {
    law_.reference_jumps();
    const bool of_link = config_.encoder_side == EncoderSide::kLink;
    const double from_rad = reading_.position_rad();
    trajectory_.go_on_from(planner_.reset(of_link ? planner_.motor_rest_rad(from_rad) : from_rad));
    reading_.replan(from_rad);
    phase_ = MotionPhase::kTracking;
  } else if (!at_place) {
    phase_ = MotionPhase::kTracking;
  } else if (phase_ == MotionPhase::kTracking && rest_periods_ > kSettlingPeriods) {
    hold_torque_Nm_ =
        config_.gravity.at(plan_.link_position_rad) + friction_.load_Nm() + law_.integral_torque_Nm();
    phase_ = MotionPhase::kResting;
  }
}

// The joint goes where it is pushed; once it stands it is held again.
bool JointController::stands_again(int elapsed_periods) noexcept {
  const double position_rad = reading_.position_rad();
  const bool moved = std::abs(position_rad - yielding_.stands_at_rad) > kStandsCounts * count_rad();
  if (moved) yielding_.stands_at_rad = position_rad;
  yielding_.periods = moved ? 0 : yielding_.periods + elapsed_periods;
  return yielding_.periods * config_.period_s >= kStands_s;
}

void JointController::yield(double load_Nm) noexcept {
  trajectory_.stop();
  yielding_ = {load_Nm, reading_.position_rad(), 0};
  law_.interrupt();
  phase_ = MotionPhase::kYielding;
}

ControllerOutput JointController::compute_torque(int elapsed_periods) noexcept {
  if (phase_ == MotionPhase::kTracking) return track(elapsed_periods);
  law_.interrupt();
  const double besides_Nm = trajectory_.load().torque_Nm;
  if (yields()) return apply(yielding_.load_Nm + config_.gravity.at(reading_.position_rad()) + besides_Nm);
  return apply(hold_torque_Nm_ + besides_Nm);
}

// A torque that no gain has part in.
ControllerOutput JointController::apply(double torque_Nm) const noexcept {
  const double limited_Nm = std::clamp(torque_Nm, -torque_limit_Nm_, torque_limit_Nm_);
  return {limited_Nm, 0.0, torque_Nm, law_.zero_velocity_weight(), limited_Nm != torque_Nm};
}

double JointController::planned_friction_Nm() const noexcept {
  const JointModel model = loaded_model();
  const auto [begin, middle, end] = plan_.acting_velocities_rad_s;
  return (1.0 + corrections_.friction_share()) * 0.5 *
         (model.friction_along_Nm(begin, middle) + model.friction_along_Nm(middle, end));
}

// At rest off its place: what holds, and the law.
double JointController::planned_torque_Nm() const noexcept {
  const ToldLoad& load = trajectory_.load();
  const double load_Nm = friction_.load_Nm() + load.torque_Nm;
  if (!planner_.moves()) return config_.gravity.at(plan_.link_position_rad) + load_Nm;
  return plan_.torque_Nm + planned_friction_Nm() + load_Nm +
         load.inertia_kgm2 * plan_.wanted_acceleration_rad_s2;
}

ControllerOutput JointController::track(int elapsed_periods) noexcept {
  ControllerInput input;
  input.elapsed_periods = elapsed_periods;
  input.joint_position_rad = reading_.position_rad();
  input.joint_velocity_rad_s = reading_.velocity_rad_s();
  input.setpoint_position_rad = place_rad();
  input.setpoint_velocity_rad_s = reading_.planned_velocity_rad_s();
  input.planned = true;
  input.planned_torque_Nm = planned_torque_Nm();
  input.torque_limit_Nm = torque_limit_Nm_;
  input.torque_max_Nm = config_.motor.available_Nm(reading_.velocity_rad_s());
  input.torque_min_Nm = -config_.motor.available_Nm(-reading_.velocity_rad_s());
  const ControllerOutput output = law_.step(input);
  if (output.saturated && speeds_up_ && !trajectory_.streamed())
    pace_ = std::max(kLeastPace, pace_ * (1.0 - elapsed_periods * config_.period_s / kPace_s));
  const double least_Nm = std::max(kSwingShare * torque_limit_Nm_, kSwingCounts * law_.count_torque_Nm());
  const double needed_Nm = std::clamp(output.feedforward_torque_Nm, -torque_limit_Nm_, torque_limit_Nm_);
  oscillation_.step(output.torque_Nm - needed_Nm, needed_Nm, least_Nm, elapsed_periods);
  return output;
}

// From an order's own motion, at a torque that is not limited and a reading that is fresh.
bool JointController::learn(const JointMeasurement& measurement, const ControllerOutput& output) noexcept {
  if (phase_ != MotionPhase::kTracking || output.saturated || planner_.exhausted() ||
      !measurement.has_position || measurement.elapsed_periods > 1)
    return false;
  const double velocity_rad_s = plan_.acting_velocities_rad_s[1];
  if (!planner_.moves())
    friction_.learn_load(output.feedback_torque_Nm, config_.period_s);
  else if (velocity_rad_s != 0.0 && !corrections_.begun())
    friction_.learn(output.feedback_torque_Nm, velocity_rad_s, config_.period_s);
  else
    return false;
  return !friction_.frozen();
}

void JointController::weigh(const ControllerOutput& output, int elapsed_periods) noexcept {
  double load_Nm = friction_.load_Nm();
  if (phase_ == MotionPhase::kTracking)
    load_Nm += output.torque_Nm - output.feedforward_torque_Nm;
  else if (yields())
    load_Nm = yielding_.load_Nm;
  else
    load_Nm = hold_torque_Nm_ - config_.gravity.at(plan_.link_position_rad);
  const double share = 1.0 - std::exp(-elapsed_periods * config_.period_s / kWeigh_s);
  shown_load_Nm_ += share * (load_Nm - shown_load_Nm_);
}

JointStep JointController::result(const ControllerOutput& output, bool learns) const noexcept {
  JointStep step;
  step.output = output;
  const double position_rad = yields() ? reading_.position_rad() : place_rad();
  step.reference = {position_rad, yields() ? 0.0 : plan_.velocity_rad_s,
                    yields() ? 0.0 : plan_.acting_acceleration_rad_s2};
  step.ordered_reference = step.reference;
  if (corrections_.begun() && !yields()) step.ordered_reference = {rest_position_rad(), 0.0, 0.0};
  step.joint_velocity_rad_s = reading_.velocity_rad_s();
  step.gains_in_use = law_.gains_in_use();
  step.at_target = !moves();
  step.off_stream = trajectory_.off_stream() && !corrections_.begun();
  step.phase = phase_;
  step.load_Nm = shown_load_Nm_;
  step.corrections = corrections_.count();
  step.learns = learns;
  step.oscillates = oscillation_.oscillates();
  return step;
}

}  // namespace strainwave
