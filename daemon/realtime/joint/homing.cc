// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/homing.h"

#include <cmath>

#include "base/durations.h"

namespace strainwave {

namespace {

constexpr double kStands_s = 0.1;
/// Of the way that the creep speed makes meanwhile.
constexpr double kStandsShare = 0.1;

}  // namespace

bool Homing::active(const JointInputs& inputs) const noexcept {
  return (config_.target == HomingTarget::kHomeSwitch && inputs.home) ||
         (config_.target == HomingTarget::kNegativeLimit && inputs.negative_limit) ||
         (config_.target == HomingTarget::kPositiveLimit && inputs.positive_limit);
}

// A limit switch in the direction of motion that is not the one looked for.
bool Homing::other_limit_ahead(const JointInputs& inputs) const noexcept {
  const bool negative = inputs.negative_limit && config_.target != HomingTarget::kNegativeLimit;
  const bool positive = inputs.positive_limit && config_.target != HomingTarget::kPositiveLimit;
  return heading_ < 0.0 ? negative : positive;
}

bool Homing::may_go_on(const Observation& observation) const noexcept {
  const double elapsed_s = seconds(observation.now_ns - begin_ns_);
  // Both limits at once are a broken wire.
  const bool both_limits = observation.inputs.negative_limit && observation.inputs.positive_limit;
  return elapsed_s <= config_.timeout_s && !both_limits &&
         std::abs(observation.joint_position_rad - begin_rad_) < config_.travel_rad;
}

Homing::Order Homing::go(Phase phase, double direction, double speed_rad_s) noexcept {
  phase_ = phase;
  heading_ = direction;
  return {Order::Kind::kMove, begin_rad_ + direction * config_.travel_rad, speed_rad_s};
}

Homing::Order Homing::halt(Phase phase) noexcept {
  phase_ = phase;
  return {Order::Kind::kStop, 0.0, 0.0};
}

Homing::Order Homing::found(double position_rad) noexcept {
  found_rad_ = position_rad;
  return halt(Phase::kResting);
}

Homing::Order Homing::begin(const Observation& observation) noexcept {
  begin_rad_ = observation.joint_position_rad;
  begin_ns_ = observation.now_ns;
  index_count_ = observation.inputs.index_count;
  turned_ = false;
  search_direction_ = config_.direction;
  const bool negative =
      config_.target == HomingTarget::kNegativeLimit || config_.target == HomingTarget::kNegativeStop;
  const bool positive =
      config_.target == HomingTarget::kPositiveLimit || config_.target == HomingTarget::kPositiveStop;
  if (negative) search_direction_ = -1.0;
  if (positive) search_direction_ = 1.0;
  stands_at_rad_ = begin_rad_;
  stands_since_ns_ = begin_ns_;
  if (!may_go_on(observation)) return fail();
  if (config_.target == HomingTarget::kIndex)
    return go(Phase::kToIndex, search_direction_, config_.creep_speed_rad_s);
  if (config_.target == HomingTarget::kNegativeStop || config_.target == HomingTarget::kPositiveStop)
    return go(Phase::kPushing, search_direction_, config_.creep_speed_rad_s);
  if (active(observation.inputs)) return go(Phase::kLeaving, -search_direction_, config_.creep_speed_rad_s);
  return go(Phase::kSearching, search_direction_, config_.search_speed_rad_s);
}

Homing::Order Homing::step(const Observation& observation) noexcept {
  const bool under_way = phase_ != Phase::kIdle && phase_ != Phase::kDone && phase_ != Phase::kFailed;
  if (!under_way) return {};
  if (!may_go_on(observation)) return fail();
  switch (phase_) {
    case Phase::kSearching:
      return search(observation);
    case Phase::kStopping:
      return observation.at_rest ? after_stop(observation) : Order{};
    case Phase::kReturning:
      if (active(observation.inputs))
        return go(Phase::kLeaving, -search_direction_, config_.creep_speed_rad_s);
      return other_limit_ahead(observation.inputs) ? fail() : Order{};
    case Phase::kLeaving:
      if (active(observation.inputs)) return other_limit_ahead(observation.inputs) ? fail() : Order{};
      if (!config_.then_index) return found(observation.joint_position_rad);
      index_count_ = observation.inputs.index_count;
      return go(Phase::kToIndex, -search_direction_, config_.creep_speed_rad_s);
    case Phase::kToIndex:
      return to_index(observation);
    case Phase::kPushing:
      return push(observation);
    case Phase::kResting:
      if (observation.at_rest) phase_ = Phase::kDone;
      return {};
    default:
      return {};
  }
}

Homing::Order Homing::search(const Observation& observation) noexcept {
  if (active(observation.inputs)) return halt(Phase::kStopping);
  if (!other_limit_ahead(observation.inputs)) return {};
  if (turned_) return fail();
  turned_ = true;
  return go(Phase::kSearching, -heading_, config_.search_speed_rad_s);
}

// A joint that stands under little torque has only its friction to overcome.
Homing::Order Homing::push(const Observation& observation) noexcept {
  if (other_limit_ahead(observation.inputs)) return fail();
  const double stands_rad = kStandsShare * config_.creep_speed_rad_s * kStands_s;
  const bool moved = std::abs(observation.joint_position_rad - stands_at_rad_) > stands_rad;
  if (moved || observation.torque_Nm * heading_ < config_.stop_torque_Nm) {
    stands_at_rad_ = observation.joint_position_rad;
    stands_since_ns_ = observation.now_ns;
    return {};
  }
  if (seconds(observation.now_ns - stands_since_ns_) < kStands_s) return {};
  (void)found(observation.joint_position_rad);
  return {Order::Kind::kMove, found_rad_, config_.creep_speed_rad_s};
}

// The switch may be narrower than the way to a stop.
Homing::Order Homing::after_stop(const Observation& observation) noexcept {
  if (active(observation.inputs)) return go(Phase::kLeaving, -search_direction_, config_.creep_speed_rad_s);
  return go(Phase::kReturning, -heading_, config_.creep_speed_rad_s);
}

Homing::Order Homing::to_index(const Observation& observation) noexcept {
  if (observation.inputs.index_count != index_count_) return found(observation.inputs.index_position_rad);
  if (!other_limit_ahead(observation.inputs)) return {};
  if (turned_ || config_.then_index) return fail();
  turned_ = true;
  return go(Phase::kToIndex, -heading_, config_.creep_speed_rad_s);
}

}  // namespace strainwave
