// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/homing.h"

#include <cmath>

#include "base/durations.h"

namespace strainwave {

namespace {

constexpr double kStands_s = 0.1;
/// A joint that rests at the end of its travel may be some counts short of it.
constexpr double kTravelled = 0.99;
/// A joint that covers less than this share of the way at homing speed stands still.
constexpr double kStandsShare = 0.1;

Homing::Phase first_phase(HomingTarget target) noexcept {
  if (target == HomingTarget::kIndex) return Homing::Phase::kToIndex;
  return target == HomingTarget::kStop ? Homing::Phase::kPushing : Homing::Phase::kSearching;
}

}  // namespace

bool Homing::at_switch(const JointInputs& inputs) const noexcept {
  return config_.target == HomingTarget::kLimitSwitch ? inputs.limit_towards(config_.direction) : inputs.home;
}

// A limit switch in the direction of motion that is not the one looked for.
bool Homing::other_limit_ahead(const JointInputs& inputs) const noexcept {
  const bool looked_for = config_.target == HomingTarget::kLimitSwitch && heading_ == config_.direction;
  return inputs.limit_towards(heading_) && !looked_for;
}

bool Homing::may_go_on(const Observation& observation) const noexcept {
  const double elapsed_s = seconds(observation.now_ns - begin_ns_);
  // Both limits at once mean a broken wire.
  const bool both_limits = observation.inputs.negative_limit && observation.inputs.positive_limit;
  return elapsed_s <= config_.timeout_s && !both_limits &&
         std::abs(observation.joint_position_rad - begin_rad_) < kTravelled * config_.travel_rad;
}

Homing::Order Homing::go(Phase phase, double direction) noexcept {
  phase_ = phase;
  heading_ = direction;
  return {Order::Kind::kMove, begin_rad_ + direction * config_.travel_rad};
}

Homing::Order Homing::found(double position_rad) noexcept {
  found_rad_ = position_rad;
  phase_ = Phase::kFound;
  return {Order::Kind::kStop, 0.0};
}

Homing::Order Homing::begin(const Observation& observation) noexcept {
  begin_rad_ = marked_rad_ = observation.joint_position_rad;
  begin_ns_ = marked_ns_ = observation.now_ns;
  index_count_ = observation.inputs.index_count;
  const Order first = go(first_phase(config_.target), config_.direction);
  const Order order = step(observation);
  return order.kind == Order::Kind::kGoOn && phase_ != Phase::kFailed ? first : order;
}

Homing::Order Homing::step(const Observation& observation) noexcept {
  if (phase_ == Phase::kIdle || phase_ == Phase::kFound || phase_ == Phase::kFailed) return {};
  if (!may_go_on(observation)) return fail();
  const JointInputs& inputs = observation.inputs;
  if (other_limit_ahead(inputs))
    return phase_ == Phase::kPushing || heading_ != config_.direction ? fail() : go(phase_, -heading_);
  if (phase_ == Phase::kPushing) return push(observation);
  if (phase_ == Phase::kToIndex)
    return inputs.index_count == index_count_ ? Order{} : found(inputs.index_position_rad);
  if (at_switch(inputs)) {
    confirmed_ = phase_ == Phase::kLeaving;
    if (confirmed_) return {};
    marked_rad_ = observation.joint_position_rad;
    return go(Phase::kLeaving, -config_.direction);
  }
  // A joint that overshot a narrow switch comes back through it. A switch that is not seen again was a disturbance.
  const bool returned = (observation.joint_position_rad - marked_rad_) * config_.direction < 0.0;
  if (phase_ != Phase::kLeaving || !returned) return {};
  if (!confirmed_) return go(Phase::kSearching, config_.direction);
  if (!config_.then_index) return found(observation.joint_position_rad);
  index_count_ = inputs.index_count;
  return go(Phase::kToIndex, heading_);
}

// A joint that stands still under less torque may only have to overcome its friction.
Homing::Order Homing::push(const Observation& observation) noexcept {
  const double stands_rad = kStandsShare * config_.speed_rad_s * kStands_s;
  const bool moved = std::abs(observation.joint_position_rad - marked_rad_) > stands_rad;
  if (moved || observation.torque_Nm * heading_ < config_.stop_torque_Nm) {
    marked_rad_ = observation.joint_position_rad;
    marked_ns_ = observation.now_ns;
  }
  if (seconds(observation.now_ns - marked_ns_) < kStands_s) return {};
  (void)found(observation.joint_position_rad);
  return {Order::Kind::kMove, found_rad_};
}

}  // namespace strainwave
