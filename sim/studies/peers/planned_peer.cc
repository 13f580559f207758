// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/planned_peer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "sim/studies/peers/cascade.h"
#include "sim/studies/peers/disturbance_observer.h"
#include "sim/studies/peers/lqg.h"

namespace strainwave {

namespace {

constexpr double kAccelerationShare = 0.6;
constexpr double kSpeedShare = 0.85;
constexpr double kLargestSpeed_rad_s = 1e3;  // for a motor without a supply's line

MotionLimits drive_limits(const JointPlantConfig& plant) {
  const MotorLimits& motor = plant.motor;
  const double acceleration = kAccelerationShare * motor.peak_torque_Nm / servo_joint(plant).inertia_kgm2;
  const double speed_rad_s =
      (motor.stall_torque_Nm - kSpeedShare * motor.peak_torque_Nm) / motor.torque_per_speed_Nms_rad;
  return {std::min(kLargestSpeed_rad_s, speed_rad_s), acceleration, acceleration};
}

int smoothing_periods(const JointPlantConfig& plant) {
  const double periods = 2.0 * std::numbers::pi / servo_joint(plant).resonance_rad_s / plant.period_s;
  return static_cast<int>(std::clamp(std::round(periods), 1.0, double{kMaxMeanPeriods}));
}

template <typename Make>
Contender peer_contender(const std::string& name, const Make& make) {
  return {name, [make](const JointPlantConfig& plant) -> std::unique_ptr<LoopController> {
            return std::make_unique<PlannedPeer>(make(servo_joint(plant)), plant);
          }};
}

}  // namespace

PlannedPeer::PlannedPeer(std::unique_ptr<ServoPeer> peer, const JointPlantConfig& plant)
    : peer_(std::move(peer)),
      period_s_(plant.period_s),
      shaper_(plant.period_s),
      mean_(smoothing_periods(plant), plant.period_s) {
  shaper_.set_limits(drive_limits(plant));
}

// Position and velocity belong to the present reading, the acceleration to the next period, in which the torque acts.
double PlannedPeer::torque_Nm(const LoopSample& sample) noexcept {
  const double read_rad = sample.joint_position_rad;
  if (!started_) {
    shaper_.reset(read_rad, 0.0);
    mean_.reset(read_rad);
    peer_->reset(read_rad);
    last_rad_ = before_last_rad_ = read_rad;
  }
  started_ = true;
  shaper_.set_target(sample.setpoint_position_rad);
  const Reference planned = shaper_.step();
  const MotionPoint ahead =
      mean_.step({planned.position_rad, planned.velocity_rad_s, planned.acceleration_rad_s2, 0.0});
  const Reference now{last_rad_, (last_rad_ - before_last_rad_) / period_s_, ahead.acceleration_rad_s2};
  before_last_rad_ = last_rad_;
  last_rad_ = ahead.position_rad;
  return peer_->step(now, read_rad);
}

std::vector<Contender> peer_contenders() {
  return {peer_contender("cascade",
                         [](const ServoJoint& joint) { return std::make_unique<CascadePeer>(joint, false); }),
          peer_contender("cascade with feed-forward",
                         [](const ServoJoint& joint) { return std::make_unique<CascadePeer>(joint, true); }),
          peer_contender("cascade with feed-forward and notch", &notched_cascade),
          peer_contender(
              "disturbance observer",
              [](const ServoJoint& joint) { return std::make_unique<DisturbanceObserverPeer>(joint); }),
          peer_contender("LQG", [](const ServoJoint& joint) { return std::make_unique<LqgPeer>(joint); })};
}

}  // namespace strainwave
