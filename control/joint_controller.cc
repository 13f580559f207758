// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint_controller.h"

#include <algorithm>
#include <cmath>

#include "control/joint/link_velocity.h"

namespace strainwave {

namespace {

// Time constant of the displayed load: longer than the torque of a count lasts.
constexpr double kWeigh_s = 0.01;
// A pushed joint that stays within this many counts stands still.
constexpr double kStandsCounts = 3.0;
// Least swing of the feedback that counts as oscillation: a share of the torque limit, and a multiple of the torque of a count.
constexpr double kSwingShare = 0.2;
constexpr double kSwingCounts = 2.0;
// Rate in 1/s at which a joint in velocity mode returns to its plan. Drives follow a velocity within some 10 ms. A tenth of that rate
// is safe with every drive that follows its velocity.
constexpr double kReturn_1_s = 10.0;

// Factor on learning with a link encoder: half the rate is stable with the spring in the loop, the full rate is not (docs/certificate.md).
constexpr double kLinkLearning = 0.5;
// A drive's own integrator is fast, so that learning from its noisy torque may be slow (strainwave-sim own-loop).
constexpr double kOwnLoopLearning = 0.1;

// Duration of swings after a motion with 30 % more friction than the table's. Half of it is too short (`strainwave-sim flexible --wrong`).
constexpr double kSwings_s = 0.2;

double learning_share(const JointControllerConfig& config) noexcept {
  if (config.drive_closes_loop()) return kOwnLoopLearning;
  return config.encoder_side == EncoderSide::kLink ? kLinkLearning : 1.0;
}

bool left_out(const JointMeasurement& measurement) noexcept {
  return measurement.elapsed_periods > kMaxElapsedPeriods;
}

// Periods by which the plan advances. Without an order a drive in position mode stands still, and the plan waits with it.
int led_periods(const JointControllerConfig& config, const JointMeasurement& measurement) noexcept {
  if (left_out(measurement) || config.drive_mode == DriveMode::kPosition) return 1;
  return std::max(1, measurement.elapsed_periods);
}

double off_rad(const JointPlan& plan, const JointReading& reading) noexcept {
  return plan.place_rad() - reading.position_rad();
}

bool at_place(const JointControllerConfig& config, double off_rad) noexcept {
  return std::abs(off_rad) <= RestCorrections::kAtPlaceCounts * count_of(config);
}

// Whether the feedback of a joint at rest shows the load. While the joint still swings, just after a motion, it does not.
bool shows_load(const JointControllerConfig& config, const JointPlan& plan,
                const JointReading& reading) noexcept {
  return reading.still_periods() * config.period_s >= RestCorrections::kStands_s ||
         plan.planner().rests_for_s() >= kSwings_s;
}

MotorOrder drive_order(const JointControllerConfig& config, const JointPlan& plan, double off_rad) noexcept {
  const bool returns =
      config.drive_mode == DriveMode::kVelocity && (plan.moves() || !at_place(config, off_rad));
  const auto [begin_rad_s, middle_rad_s, end_rad_s] = plan.now().acting_velocities_rad_s;
  const double earlier = 2.0 * config.drive_loop_period_s / config.period_s;  // in half periods
  return {plan.now().acting_end_position_rad,
          middle_rad_s - earlier * (middle_rad_s - begin_rad_s) + (returns ? kReturn_1_s * off_rad : 0.0)};
}

double share_of_velocity(const JointControllerConfig& config) noexcept {
  return config.link ? velocity_share(config.encoder_side, config.period_s) : 1.0;
}

}  // namespace

JointController::JointController(const JointControllerConfig& config) noexcept
    : config_(config),
      plan_(config),
      law_(config.period_s, config.encoder_resolution_rad, share_of_velocity(config)),
      reading_(config.period_s, share_of_velocity(config), count_of(config)),
      oscillation_(config.period_s) {}

void JointController::load(const GainTable& table) noexcept {
  law_.load(table);
  model_.inertia_kgm2 = config_.link ? config_.link->inertia_kgm2() : table.plant.inertia_kgm2;
  if (!config_.link) plan_.set_rigid_inertia(table.plant.inertia_kgm2);
  model_.stribeck = table.friction.velocity.stribeck();
  friction_.load(table.friction);
  friction_.weigh(law_.temperature_weights());
  torque_limit_Nm_ = config_.torque_limit_with(table);
}

void JointController::start(double position_rad, double velocity_rad_s,
                            std::optional<double> holding_torque_Nm) noexcept {
  plan_.start(position_rad, velocity_rad_s);
  reading_.reset(position_rad, velocity_rad_s);
  law_.begin_anew();
  oscillation_.reset();
  const double gravity_Nm = config_.gravity.at(position_rad);
  if (holding_torque_Nm) friction_.set_load(*holding_torque_Nm - gravity_Nm);
  hold_torque_Nm_ = gravity_Nm + friction_.load_Nm();
  shown_load_Nm_ = friction_.load_Nm();
  phase_ = velocity_rad_s == 0.0 ? MotionPhase::kResting : MotionPhase::kTracking;
}

void JointController::yield(double load_Nm) noexcept {
  plan_.stop();
  yielding_ = {load_Nm, reading_.position_rad(), 0};
  law_.interrupt();
  phase_ = MotionPhase::kYielding;
}

double JointController::holding_torque_Nm() const noexcept {
  return shown_load_Nm_ + config_.gravity.at(plan_.now().link_position_rad) +
         plan_.trajectory().load().torque_Nm;
}

PlannedJoint JointController::joint() const noexcept {
  PlannedJoint joint{model_, friction_.load_Nm(), torque_limit_Nm_, driving_share_ * torque_limit_Nm_};
  joint.model.inertia_kgm2 += plan_.trajectory().load().inertia_kgm2;
  joint.model.friction = friction_.friction();
  return joint;
}

JointStep JointController::step(const JointMeasurement& measurement) noexcept {
  if (!law_.loaded()) return {};
  const int elapsed_periods = led_periods(config_, measurement);
  if (measurement.temperature_valid && law_.set_temperature(measurement.temperature_C))
    friction_.weigh(law_.temperature_weights());
  if (yields()) {
    reading_.step(measurement, plan_.now().position_rad, plan_.now().position_rad);
    yielding_.see(reading_.position_rad(), count_of(config_), elapsed_periods);
    if (yielding_.periods * config_.period_s >= RestCorrections::kStands_s) hold_again();
  } else {
    advance_plan(measurement);
    reading_.step(measurement, plan_.place_before_rad(0), plan_.place_before_rad(measurement.late_periods));
    choose_phase();
  }
  const ControllerOutput output = compute_torque(measurement);
  const bool learns = learn(measurement, output);
  weigh(output, elapsed_periods);
  return result(output, learns);
}

// After a gap in which the loop did not run, a motion continues from the joint's position.
void JointController::advance_plan(const JointMeasurement& measurement) noexcept {
  if (left_out(measurement) && plan_.moves()) {
    const double passed_s = measurement.elapsed_periods * config_.period_s;
    const bool seen = measurement.has_position;
    const double position_rad = seen ? measurement.joint_position_rad : reading_.position_rad();
    const double velocity_rad_s = seen ? (position_rad - reading_.position_rad()) / passed_s : 0.0;
    law_.reference_jumps();
    plan_.go_on_from(position_rad, velocity_rad_s);
    reading_.reset(position_rad, plan_.now().velocity_rad_s);
  }
  for (int period = 0; period < led_periods(config_, measurement); ++period) {
    plan_.advance(joint());
    if (const double load_Nm = plan_.take_load_Nm(); load_Nm != 0.0) {
      friction_.set_load(friction_.load_Nm() + load_Nm);
      hold_torque_Nm_ += load_Nm;
    }
  }
}

void JointController::choose_phase() noexcept {
  if (plan_.moves()) {
    phase_ = MotionPhase::kTracking;
    return;
  }
  if (config_.drive_closes_loop()) return;
  friction_.end_motion();
  const double off = off_rad(plan_, reading_);
  if (plan_.correct(off, reading_.position_rad(), reading_.still_periods())) {
    law_.reference_jumps();
    reading_.replan(reading_.position_rad());
    phase_ = MotionPhase::kTracking;
  } else if (!at_place(config_, off) || config_.without == Mechanism::kRestTorque) {
    phase_ = MotionPhase::kTracking;
  } else if (phase_ == MotionPhase::kTracking) {
    hold_torque_Nm_ =
        config_.gravity.at(plan_.now().link_position_rad) + friction_.load_Nm() + law_.integral_torque_Nm();
    phase_ = MotionPhase::kResting;
  }
}

// Counts the time for which the pushed joint has stood still.
void JointController::Yielding::see(double position_rad, double count_rad, int elapsed_periods) noexcept {
  const bool moved = std::abs(position_rad - stands_at_rad) > kStandsCounts * count_rad;
  if (moved) stands_at_rad = position_rad;
  periods = moved ? 0 : periods + elapsed_periods;
}

// The push has ended. The plan starts at this period's reading; in the next period both are one step of this velocity farther.
void JointController::hold_again() noexcept {
  const double position_rad = reading_.position_rad();
  start(position_rad, reading_.velocity_rad_s(), yielding_.load_Nm + config_.gravity.at(position_rad));
  reading_.has_been_read();
  advance_plan({});
}

// The law gives the torque only while tracking. If the drive closes the loop there is no law: the torque that the drive adds to its
// feed-forward takes the place of the feedback.
ControllerOutput JointController::compute_torque(const JointMeasurement& measurement) noexcept {
  if (config_.drive_closes_loop()) {
    const double fed_Nm = plan_.torque_Nm(joint());
    return {std::clamp(fed_Nm, -torque_limit_Nm_, torque_limit_Nm_),
            measurement.drive_torque_Nm.value_or(fed_Nm) - fed_Nm, fed_Nm, law_.zero_velocity_weight(),
            false};
  }
  if (phase_ == MotionPhase::kTracking) return track(led_periods(config_, measurement));
  law_.interrupt();
  const double held_Nm =
      yields() ? yielding_.load_Nm + config_.gravity.at(reading_.position_rad()) : hold_torque_Nm_;
  const double torque_Nm = held_Nm + plan_.trajectory().load().torque_Nm;
  const double limited_Nm = std::clamp(torque_Nm, -torque_limit_Nm_, torque_limit_Nm_);
  return {limited_Nm, 0.0, torque_Nm, law_.zero_velocity_weight(), limited_Nm != torque_Nm};
}

ControllerOutput JointController::track(int elapsed_periods) noexcept {
  ControllerInput input;
  input.elapsed_periods = elapsed_periods;
  input.joint_position_rad = reading_.position_rad();
  input.joint_velocity_rad_s = reading_.velocity_rad_s();
  input.setpoint_position_rad = plan_.place_rad();
  input.setpoint_velocity_rad_s = reading_.planned_velocity_rad_s();
  input.feedforward_torque_Nm = plan_.torque_Nm(joint());
  input.torque_limit_Nm = torque_limit_Nm_;
  input.torque_max_Nm = config_.motor.available_Nm(reading_.velocity_rad_s());
  input.torque_min_Nm = -config_.motor.available_Nm(-reading_.velocity_rad_s());
  const ControllerOutput output = law_.step(input);
  if (output.saturated) plan_.slow_down(elapsed_periods * config_.period_s);
  const double least_Nm = std::max(kSwingShare * torque_limit_Nm_, kSwingCounts * law_.count_torque_Nm());
  const double needed_Nm = std::clamp(output.feedforward_torque_Nm, -torque_limit_Nm_, torque_limit_Nm_);
  oscillation_.step(output.torque_Nm - needed_Nm, needed_Nm, least_Nm, elapsed_periods);
  return output;
}

// Learns from an ordered motion with an unlimited torque and a fresh reading; at rest learns the load alone.
bool JointController::learn(const JointMeasurement& measurement, const ControllerOutput& output) noexcept {
  if (phase_ != MotionPhase::kTracking || output.saturated || plan_.planner().exhausted() ||
      !measurement.has_position || measurement.elapsed_periods > 1)
    return false;
  const double velocity_rad_s = plan_.now().acting_velocities_rad_s[1];
  const bool moves = plan_.planner().moves();
  // At rest, friction may hold the torque that a drive adds.
  if (config_.drive_closes_loop() && (!moves || !measurement.drive_torque_Nm)) return false;
  if (config_.without == (moves ? Mechanism::kFrictionLearning : Mechanism::kLoadLearning)) return false;
  const double learns_for_s = config_.period_s * learning_share(config_);
  if (!moves && shows_load(config_, plan_, reading_))
    friction_.learn_load(output.feedback_torque_Nm, learns_for_s);
  else if (moves && velocity_rad_s != 0.0 && !plan_.corrections().begun())
    friction_.learn(output.feedback_torque_Nm, velocity_rad_s, learns_for_s);
  else
    return false;
  return !friction_.frozen();
}

void JointController::weigh(const ControllerOutput& output, int elapsed_periods) noexcept {
  double load_Nm = friction_.load_Nm();
  if (config_.drive_closes_loop())
    load_Nm += output.feedback_torque_Nm;
  else if (phase_ == MotionPhase::kTracking)
    load_Nm += output.torque_Nm - output.feedforward_torque_Nm;
  else if (yields())
    load_Nm = yielding_.load_Nm;
  else
    load_Nm = hold_torque_Nm_ - config_.gravity.at(plan_.now().link_position_rad);
  const double share = 1.0 - std::exp(-elapsed_periods * config_.period_s / kWeigh_s);
  shown_load_Nm_ += share * (load_Nm - shown_load_Nm_);
}

JointStep JointController::result(const ControllerOutput& output, bool learns) const noexcept {
  JointStep step;
  step.output = output;
  if (config_.drive_closes_loop()) step.order = drive_order(config_, plan_, off_rad(plan_, reading_));
  const double position_rad = yields() ? reading_.position_rad() : plan_.place_rad();
  step.reference = {position_rad, yields() ? 0.0 : plan_.now().velocity_rad_s,
                    yields() ? 0.0 : plan_.now().acting_acceleration_rad_s2};
  step.ordered_reference = step.reference;
  if (plan_.corrections().begun() && !yields())
    step.ordered_reference = {plan_.rest_position_rad(), 0.0, 0.0};
  step.joint_velocity_rad_s = reading_.velocity_rad_s();
  step.at_target = !plan_.moves();
  step.off_stream = plan_.trajectory().off_stream() && !plan_.corrections().begun();
  step.phase = phase_;
  step.load_Nm = shown_load_Nm_;
  step.corrections = plan_.corrections().count();
  step.learns = learns;
  step.oscillates = oscillation_.oscillates();
  return step;
}

}  // namespace strainwave
