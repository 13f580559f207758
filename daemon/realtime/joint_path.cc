// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint_path.h"

#include <cmath>

namespace strainwave {

namespace {
// A path begins where the joint holds. What it may be off is what the setpoint then catches up with.
constexpr double kBeginsWithin_rad = 1e-3;
}  // namespace

Ruling take_path(JointInLoop& joint, const Order& order) noexcept {
  if (joint.mode.is(Mode::kFaulted)) return Reason::kFaulted;
  const LoadedPath& offered = joint.path_slots.at(order.path_slot);
  const Ruling ruling = may_begin_path(joint, offered);
  if (ruling.reason != Reason::kAccepted) return ruling;
  joint.path = &offered;
  joint.path_slots.use(order.path_slot);
  return Reason::kAccepted;
}

Ruling may_begin_path(const JointInLoop& joint, const LoadedPath& path) noexcept {
  if (joint.service == JointInLoop::Service::kEnding) return Reason::kEnding;
  if (!joint.zero.known()) return Reason::kNotHomed;
  if (joint.mode.is(Mode::kTracking)) return Reason::kMoving;
  if (!joint.mode.is(Mode::kHolding)) return Reason::kWrongMode;
  const double begins_rad = joint.zero.to_drive_rad(path.path.knots[0].position_rad);
  const double off_rad = std::abs(begins_rad - joint.law.controller().plan().trajectory().target_rad());
  if (!(off_rad <= kBeginsWithin_rad)) return {Reason::kOutOfRange, off_rad, kBeginsWithin_rad};
  return Reason::kAccepted;
}

void begin_path(JointInLoop& joint, const CycleTime& time) noexcept {
  (void)joint.change_mode(ModeEvent::kSetpointAccepted, time);
  joint.yield.reset();
  const double end_rad = joint.path->path.last().position_rad;
  joint.ordered.begin_path(end_rad, joint.zero.to_drive_rad(end_rad));
}

void follow_path(JointInLoop& joint, const PathPoint& point, std::int64_t in_periods) noexcept {
  joint.law.controller().follow_path(joint.zero.to_drive_rad(point.position_rad), point.velocity_rad_s,
                                     in_periods, joint.reachable_range());
}

void stop_beside_path(JointInLoop& joint) noexcept {
  joint.law.controller().stop();
  joint.end_orders();
}

}  // namespace strainwave
