// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "base/printable.h"
#include "daemon/realtime/joint/joint_in_loop.h"

namespace strainwave {

namespace {

// The joint yields once to a push. A load that does not end, or returns as soon as the joint holds again, is a fault.
void stop_overloaded(JointInLoop& joint, const CycleTime& time) noexcept {
  const bool may_hold =
      joint.config.overload_stop == OverloadStop::kHoldLoad && !joint.mode.is(Mode::kHoming);
  if (!may_hold || joint.law.controller().yields() || joint.motion_watch.has_just_yielded(time.now_ns))
    return joint.raise_fault(Fault::kOverload, time);
  joint.yield = {joint.law.motion().load_Nm, joint.motion_watch.loads().load_Nm,
                 joint.zero.to_joint_rad(joint.drive.position_rad())};
  joint.stream.yielded_id = joint.ordered.stream_id();
  const Mode mode = joint.mode.mode();
  (void)joint.events.push({joint.index, time.cycle, mode, mode, Fault::kNone, 0, joint.yield});
  joint.end_orders();
  joint.law.controller().yield(joint.motion_watch.usual_load_Nm());
}

}  // namespace

void note_limits(JointInLoop& joint) noexcept {
  const JointStep& motion = joint.law.motion();
  if (motion.output.saturated) joint.notice(Notice::kTorqueLimited);
  if (motion.off_stream) joint.notice(Notice::kOffStream);
  if (joint.law.shows_other_inertia()) joint.notice(Notice::kOtherInertia);
  const FuzzyFriction& friction = joint.law.table()->table.friction;
  const TemperatureCheck& temperature = joint.drive.temperature();
  if (temperature.known() && (temperature.used_C() < friction.temperature_min_C ||
                              temperature.used_C() > friction.temperature_max_C))
    joint.notice(Notice::kTemperatureClamped);
  const double speed_limit_rad_s = joint.config.controller.motion.velocity_rad_s;
  if (std::abs(motion.reference.velocity_rad_s) >= (1.0 - kAtBound) * speed_limit_rad_s)
    joint.notice(Notice::kSpeedLimited);
}

void check_motion(JointInLoop& joint, const CycleTime& time) noexcept {
  if (!joint.mode.controlled()) return;
  const JointLimits& limits = joint.config.limits;
  const JointStep& motion = joint.law.motion();
  const double position_rad = joint.drive.position_rad();
  const double joint_rad = joint.zero.to_joint_rad(position_rad);
  if (joint.zero.known() && (joint_rad < limits.position_min_rad - limits.position_margin_rad ||
                             joint_rad > limits.position_max_rad + limits.position_margin_rad))
    return joint.raise_fault(Fault::kPositionLimit, time);
  if (!joint.mode.is(Mode::kHoming) &&
      joint.drive.reading().inputs.limit_towards(motion.reference.velocity_rad_s))
    return joint.raise_fault(Fault::kLimitSwitch, time);
  if (motion.oscillates) return joint.raise_fault(Fault::kChatter, time, joint.law.evidence());
  // The load pushes a yielding joint too fast, so the fault is an overload.
  if (std::abs(motion.joint_velocity_rad_s) > limits.overspeed_rad_s)
    return joint.raise_fault(joint.law.controller().yields() ? Fault::kOverload : Fault::kSpeedLimit, time);
  // Until the brake is open, the joint stands still whatever the order.
  if (joint.mode.is(Mode::kReleasing)) return joint.motion_watch.begin(position_rad, time.now_ns);
  const Fault fault = joint.motion_watch.judge(motion, position_rad, time.now_ns);
  if (joint.motion_watch.high_load()) joint.notice(Notice::kLoadHigh);
  if (fault == Fault::kOverload)
    stop_overloaded(joint, time);
  else if (fault != Fault::kNone)
    joint.raise_fault(fault, time);
  const double off_rad = position_rad - joint.law.controller().plan().rest_position_rad();
  if (joint.motion_watch.off_target(joint.mode.is(Mode::kHolding), off_rad, time.now_ns))
    joint.notice(Notice::kOffTarget);
}

}  // namespace strainwave
