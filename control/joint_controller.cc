#include "control/joint_controller.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "control/joint/link_velocity.h"
#include "control/units.h"

namespace strainwave {

namespace {

// Where exact sensing, which has no counts, takes a joint to be at its place.
constexpr double kExactCount_rad = 1e-6;

double count_of(const JointControllerConfig& config) noexcept {
  return std::max(config.encoder_resolution_rad, kExactCount_rad);
}

double share_of_velocity(const JointControllerConfig& config) noexcept {
  return config.link ? velocity_share(config.encoder_side, config.period_s) : 1.0;
}

MotorPlannerConfig planner_config(const JointControllerConfig& config) noexcept {
  MotorPlannerConfig planner;
  planner.period_s = config.period_s;
  planner.joint = config.link ? *config.link : LinkModel::rigid_joint(1.0);
  planner.joint.gravity = config.gravity;
  planner.torque_limit_Nm = config.torque_limit_Nm;
  planner.delay_periods = config.delay_periods;
  planner.tolerance_rad = 0.5 * count_of(config);
  planner.motion = config.motion;
  planner.jerk_limit_rad_s3 = config.jerk_limit_rad_s3;
  return planner;
}

}  // namespace

JointController::JointController(const JointControllerConfig& config) noexcept
    : config_(config),
      trajectory_({config.period_s, config.stream_bridge_s, config.stream_delay_s, count_of(config)}),
      planner_(planner_config(config)),
      law_(config.period_s, config.encoder_resolution_rad, share_of_velocity(config),
           config.link.has_value()),
      reading_(config.period_s, share_of_velocity(config), count_of(config)),
      corrections_(config.period_s, count_of(config)),
      oscillation_(config.period_s) {
  config_.motion = MotorPlanner::possible_limits(planner_config(config));
  motion_ = config_.motion;
}

void JointController::load(const GainTable& table) noexcept {
  law_.load(table);
  model_.inertia_kgm2 = config_.link ? config_.link->inertia_kgm2() : table.plant.inertia_kgm2;
  if (!config_.link) planner_.set_rigid_inertia(table.plant.inertia_kgm2);
  model_.stribeck = table.friction.velocity.stribeck();
  friction_.load(table.friction);
  friction_.weigh(law_.temperature_weights());
  torque_limit_Nm_ = config_.torque_limit_with(table);
}

void JointController::start(double position_rad, double velocity_rad_s,
                            std::optional<double> holding_torque_Nm) noexcept {
  begin_order(0.0);
  const double fastest = motion_.velocity_rad_s;
  const double begin_rad_s = std::clamp(velocity_rad_s, -fastest, fastest);
  trajectory_.start(begin_plan(position_rad, begin_rad_s), begin_rad_s);
  reading_.reset(position_rad, velocity_rad_s);
  law_.begin_anew();
  oscillation_.reset();
  const double gravity_Nm = config_.gravity.at(position_rad);
  if (holding_torque_Nm) friction_.set_load(*holding_torque_Nm - gravity_Nm);
  hold_torque_Nm_ = gravity_Nm + friction_.load_Nm();
  shown_load_Nm_ = friction_.load_Nm();
  phase_ = velocity_rad_s == 0.0 ? MotionPhase::kResting : MotionPhase::kTracking;
}

// A motion at constant velocity from where the encoder reads `reading_rad`. Where the trajectory, which is ahead, must go on from.
double JointController::begin_plan(double reading_rad, double velocity_rad_s) noexcept {
  const bool of_link = config_.encoder_side == EncoderSide::kLink;
  const double motor_rad = of_link ? planner_.motor_rest_rad(reading_rad) : reading_rad;
  plan_ = {};
  plan_.position_rad = motor_rad;
  plan_.link_position_rad = reading_rad;
  plan_.velocity_rad_s = velocity_rad_s;
  rest_periods_ = 0;
  return planner_.reset(motor_rad, velocity_rad_s);
}

void JointController::begin_order(double speed_limit_rad_s) noexcept {
  motion_ = config_.motion;
  if (speed_limit_rad_s > 0.0) motion_.velocity_rad_s = std::min(motion_.velocity_rad_s, speed_limit_rad_s);
}

void JointController::set_target(double position_rad, double speed_limit_rad_s) noexcept {
  const bool repeated = !trajectory_.streamed() && position_rad == trajectory_.target_rad();
  begin_order(speed_limit_rad_s);
  trajectory_.set_target(position_rad);
  if (repeated) return;
  corrections_.reset();
  pace_ = 1.0;
}

SampleFate JointController::follow(const StreamSample& sample, bool begins, double speed_limit_rad_s,
                                   const PositionRange& range) noexcept {
  begin_order(speed_limit_rad_s);
  if (begins) pace_ = 1.0;
  return trajectory_.follow(sample, begins, lead_s() / config_.period_s, motion_, range);
}

void JointController::follow_path(double position_rad, double velocity_rad_s, std::int64_t in_periods,
                                  const PositionRange& range) noexcept {
  begin_order(0.0);
  trajectory_.follow_path(position_rad, velocity_rad_s, in_periods, range);
}

// What a stream had named of the load is what the joint carries from now on, as far as is known.
void JointController::keep_load() noexcept {
  if (trajectory_.streamed() || trajectory_.load().torque_Nm == 0.0) return;
  const double load_Nm = trajectory_.take_load_Nm();
  friction_.set_load(friction_.load_Nm() + load_Nm);
  hold_torque_Nm_ += load_Nm;
}

double JointController::lead_s() const noexcept {
  return config_.delay_periods * config_.period_s + 0.5 * planner_.spread_s();
}

double JointController::rest_position_rad() const noexcept {
  const double target_rad = trajectory_.present_target_rad();
  return config_.encoder_side == EncoderSide::kLink ? target_rad : planner_.motor_rest_rad(target_rad);
}

double JointController::holding_torque_Nm() const noexcept {
  return shown_load_Nm_ + config_.gravity.at(plan_.link_position_rad) + trajectory_.load().torque_Nm;
}

JointModel JointController::loaded_model() const noexcept {
  JointModel model = model_;
  model.inertia_kgm2 += trajectory_.load().inertia_kgm2;
  model.friction = friction_.friction();
  return model;
}

JointStep JointController::step(const JointMeasurement& measurement) noexcept {
  if (!has_table()) return {};
  const bool missed = measurement.elapsed_periods > kMaxElapsedPeriods;
  const int elapsed_periods = missed ? 1 : std::max(1, measurement.elapsed_periods);
  choose_gains(measurement);
  if (missed && !yields() && moves()) go_on_from(measurement);
  if (!yields()) advance_plan(elapsed_periods);
  read(measurement);
  if (!yields())
    choose_phase();
  else if (stands_again(elapsed_periods))
    hold_again();
  const ControllerOutput output = compute_torque(elapsed_periods);
  const bool learns = learn(measurement, output);
  weigh(output, elapsed_periods);
  return result(output, learns);
}

double JointController::count_rad() const noexcept {
  return count_of(config_);
}

// What pushed the joint has let go. The next reading is one period of this velocity farther, and so is the plan.
void JointController::hold_again() noexcept {
  const double position_rad = reading_.position_rad();
  start(position_rad, reading_.velocity_rad_s(), yielding_.load_Nm + config_.gravity.at(position_rad));
  reading_.has_been_read();
  advance_plan(1);
}

}  // namespace strainwave
