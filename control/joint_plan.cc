// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint_plan.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace strainwave {

namespace {

// Resolution that is assumed for exact sensing, which has no counts.
constexpr double kExactCount_rad = 1e-6;
// While a motion speeds up with a saturated torque, its accelerations fall by a factor of e in this time, down to the least share. With 30 %
// more load than configured and 1 rad at full torque, the link overshoots by 9 mrad instead of 97 (`strainwave-sim flexible --wrong`).
constexpr double kPace_s = 0.2;
constexpr double kLeastPace = 0.3;

MotorPlannerConfig planner_config(const JointControllerConfig& config) noexcept {
  MotorPlannerConfig planner;
  planner.period_s = config.period_s;
  planner.joint = config.link ? *config.link : LinkModel::rigid_joint(1.0);
  if (config.without == Mechanism::kWindUp)
    planner.joint = LinkModel::rigid_joint(planner.joint.inertia_kgm2());
  planner.gives_way = config.without != Mechanism::kGivingWay;
  planner.joint.gravity = config.gravity;
  planner.torque_limit_Nm = config.torque_limit_Nm;
  planner.delay_periods = config.delay_periods;
  planner.tolerance_rad = 0.5 * count_of(config);
  planner.motion = config.motion;
  planner.jerk_limit_rad_s3 = config.jerk_limit_rad_s3;
  return planner;
}

// The encoder's reading for these positions of link and motor.
double by_encoder(const JointControllerConfig& config, double link_rad, double motor_rad) noexcept {
  return config.encoder_side == EncoderSide::kLink ? link_rad : motor_rad;
}

}  // namespace

double count_of(const JointControllerConfig& config) noexcept {
  return std::max(config.encoder_resolution_rad, kExactCount_rad);
}

JointPlan::JointPlan(const JointControllerConfig& config) noexcept
    : config_(config),
      trajectory_({config.period_s, config.stream_bridge_s, config.stream_delay_s, count_of(config)}),
      planner_(planner_config(config)),
      corrections_(config.period_s, count_of(config)) {
  config_.motion = MotorPlanner::possible_limits(planner_config(config));
  motion_ = config_.motion;
}

void JointPlan::start(double reading_rad, double velocity_rad_s) noexcept {
  begin_order(0.0);
  const double fastest = motion_.velocity_rad_s;
  const double begin_rad_s = std::clamp(velocity_rad_s, -fastest, fastest);
  trajectory_.start(begin_plan(reading_rad, begin_rad_s, config_.gravity.at(reading_rad)), begin_rad_s);
}

// Starts a plan at constant velocity where the encoder reads `reading_rad`. The first change of torque counts from `torque_Nm`.
// Returns the position from which the trajectory, which leads the plan, must continue.
double JointPlan::begin_plan(double reading_rad, double velocity_rad_s, double torque_Nm) noexcept {
  const double motor_rad = by_encoder(config_, planner_.motor_rest_rad(reading_rad), reading_rad);
  plan_ = {};
  plan_.position_rad = plan_.acting_end_position_rad = motor_rad;
  plan_.link_position_rad = reading_rad;
  plan_.velocity_rad_s = velocity_rad_s;
  plan_.torque_Nm = torque_Nm;
  return planner_.reset(motor_rad, velocity_rad_s);
}

void JointPlan::begin_order(double speed_limit_rad_s) noexcept {
  motion_ = config_.motion;
  if (speed_limit_rad_s > 0.0) motion_.velocity_rad_s = std::min(motion_.velocity_rad_s, speed_limit_rad_s);
}

void JointPlan::set_target(double position_rad, double speed_limit_rad_s) noexcept {
  const bool repeated = !trajectory_.streamed() && position_rad == trajectory_.target_rad();
  begin_order(speed_limit_rad_s);
  trajectory_.set_target(position_rad);
  if (repeated) return;
  corrections_.reset();
  pace_ = 1.0;
}

SampleFate JointPlan::follow(const StreamSample& sample, bool begins, double speed_limit_rad_s,
                             const PositionRange& range) noexcept {
  begin_order(speed_limit_rad_s);
  if (begins) pace_ = 1.0;
  return trajectory_.follow(sample, begins, lead_s() / config_.period_s, motion_, range);
}

void JointPlan::follow_path(double position_rad, double velocity_rad_s, std::int64_t in_periods,
                            const PositionRange& range) noexcept {
  begin_order(0.0);
  if (!trajectory_.streamed()) pace_ = 1.0;
  trajectory_.follow_path(position_rad, velocity_rad_s, in_periods, range);
}

void JointPlan::go_on_from(double reading_rad, double velocity_rad_s) noexcept {
  const double fastest = config_.motion.velocity_rad_s;
  const double begin_rad_s = std::clamp(velocity_rad_s, -fastest, fastest);
  trajectory_.go_on_from(begin_plan(reading_rad, begin_rad_s, plan_.torque_Nm), begin_rad_s);
}

// Limits of the joint at the speed that the reference has reached.
MotionLimits JointPlan::present_limits(const PlannedJoint& joint) const noexcept {
  MotionLimits limits = reachable_limits(
      motion_, config_.motor, joint.model,
      config_.gravity.at(plan_.link_position_rad) + trajectory_.load().torque_Nm + joint.load_Nm,
      {joint.driving_Nm, joint.torque_limit_Nm}, config_.torque_reserve,
      std::abs(trajectory_.velocity_rad_s()), config_.period_s);
  limits.acceleration_rad_s2 *= pace_;
  limits.deceleration_rad_s2 *= pace_;
  return limits;
}

void JointPlan::advance(const PlannedJoint& joint) noexcept {
  const double last_target_rad = trajectory_.present_target_rad();
  const Reference planned = trajectory_.step(present_limits(joint));
  if (trajectory_.streamed() && trajectory_.present_target_rad() != last_target_rad) corrections_.reset();
  speeds_up_ = planned.velocity_rad_s * planned.acceleration_rad_s2 > 0.0;
  const StreamLoad& load = trajectory_.load();
  const double speed_rad_s = plan_.acting_velocities_rad_s.back();
  const double taken_Nm = sign(speed_rad_s) * joint.model.friction_Nm(speed_rad_s) + joint.load_Nm +
                          load.torque_Nm + load.inertia_kgm2 * plan_.wanted_acceleration_rad_s2;
  const auto available_Nm = [&](double along_rad_s) {
    return std::min(joint.torque_limit_Nm, config_.motor.available_Nm(along_rad_s));
  };
  const double last_Nm = plan_.torque_Nm;
  plan_ = planner_.step(
      planned, {-available_Nm(-speed_rad_s) - taken_Nm, available_Nm(speed_rad_s) - taken_Nm}, taken_Nm);
  change_Nm_ = plan_.torque_Nm - last_Nm;
  if (moves()) corrections_.motion();
}

double JointPlan::take_load_Nm() noexcept {
  return trajectory_.streamed() || trajectory_.load().torque_Nm == 0.0 ? 0.0 : trajectory_.take_load_Nm();
}

void JointPlan::slow_down(double elapsed_s) noexcept {
  if (config_.without == Mechanism::kPace) return;
  if (speeds_up_ && !trajectory_.streamed())
    pace_ = std::max(kLeastPace, pace_ * (1.0 - elapsed_s / kPace_s));
}

bool JointPlan::correct(double off_rad, double reading_rad, int still_periods) noexcept {
  if (config_.without == Mechanism::kCorrections || !corrections_.begins(off_rad, still_periods))
    return false;
  trajectory_.go_on_from(
      planner_.reset(by_encoder(config_, planner_.motor_rest_rad(reading_rad), reading_rad)));
  return true;
}

double JointPlan::place_rad() const noexcept {
  return by_encoder(config_, plan_.link_position_rad, plan_.position_rad);
}

double JointPlan::place_before_rad(int periods) const noexcept {
  const LinkState state = planner_.before(std::clamp(periods, 0, kMaxControlDelay));
  return by_encoder(config_, state.link_position_rad, state.motor_position_rad);
}

double JointPlan::rest_position_rad() const noexcept {
  const double target_rad = trajectory_.present_target_rad();
  return by_encoder(config_, target_rad, planner_.motor_rest_rad(target_rad));
}

double JointPlan::lead_s() const noexcept {
  return config_.delay_periods * config_.period_s + 0.5 * planner_.spread_s();
}

double JointPlan::torque_Nm(const PlannedJoint& joint) const noexcept {
  const StreamLoad& load = trajectory_.load();
  const double load_Nm = joint.load_Nm + load.torque_Nm;
  if (!planner_.moves()) return config_.gravity.at(plan_.link_position_rad) + load_Nm;
  const auto [begin, middle, end] = plan_.acting_velocities_rad_s;
  const double share = config_.without == Mechanism::kFriction ? 0.0 : 1.0 + corrections_.friction_share();
  const double friction_Nm =
      0.5 * (joint.model.friction_along_Nm(begin, middle) + joint.model.friction_along_Nm(middle, end));
  // A drive's own loop applies the torque one loop period later: its last change is extrapolated. A reversal's friction step cannot be.
  const double later_Nm = config_.drive_loop_period_s / config_.period_s * change_Nm_;
  return plan_.torque_Nm + later_Nm + share * friction_Nm + load_Nm +
         load.inertia_kgm2 * plan_.wanted_acceleration_rad_s2;
}

}  // namespace strainwave
