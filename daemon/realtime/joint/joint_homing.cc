// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/joint_in_loop.h"

namespace strainwave {

namespace {

Homing::Observation observe(const JointInLoop& joint, const CycleTime& time) noexcept {
  const bool own_loop = joint.config.controller.drive_closes_loop();
  return {joint.drive.position_rad(), joint.drive.reading().inputs, time.now_ns,
          own_loop ? joint.drive.reading().torque_applied_Nm : joint.law.motion().output.torque_Nm};
}

void follow_homing(JointInLoop& joint, const Homing::Order& order) noexcept {
  switch (order.kind) {
    case Homing::Order::Kind::kGoOn:
      return;
    case Homing::Order::Kind::kMove:
      joint.law.controller().set_target(order.target_rad, joint.config.homing.speed_rad_s);
      return;
    case Homing::Order::Kind::kStop:
      joint.law.controller().stop();
      return;
  }
}

// A drive that does not measure its torque would press against the stop until another fault.
bool presses_unseen(const JointInLoop& joint) noexcept {
  return joint.config.controller.drive_closes_loop() && joint.config.homing.stop_torque_Nm > 0.0 &&
         !joint.drive.reading().torque_measured;
}

}  // namespace

Reason begin_homing(JointInLoop& joint, const CycleTime& time) noexcept {
  if (joint.mode.is(Mode::kFaulted)) return Reason::kFaulted;
  if (joint.ending) return Reason::kEnding;
  if (!joint.homing.possible() || presses_unseen(joint)) return Reason::kNoHoming;
  if (!joint.change_mode(ModeEvent::kHomeOrdered, time)) return Reason::kWrongMode;
  joint.zero.forget();
  joint.yield.reset();
  joint.ordered.forget();
  follow_homing(joint, joint.homing.begin(observe(joint, time)));
  return Reason::kAccepted;
}

void advance_homing(JointInLoop& joint, const CycleTime& time) noexcept {
  if (!joint.mode.is(Mode::kHoming)) return;
  if (joint.drive.fresh()) follow_homing(joint, joint.homing.step(observe(joint, time)));
  if (joint.homing.phase() == Homing::Phase::kFailed) joint.raise_fault(Fault::kHomingFailed, time);
}

void end_homing(JointInLoop& joint, const CycleTime& time) noexcept {
  const bool found = joint.homing.phase() == Homing::Phase::kFound;
  if (!joint.law.motion().at_target || !(found || joint.homing.phase() == Homing::Phase::kIdle)) return;
  if (found) joint.zero.set(joint.homing.found_rad(), joint.config.homing.home_position_rad);
  (void)joint.change_mode(ModeEvent::kArrived, time);
}

}  // namespace strainwave
