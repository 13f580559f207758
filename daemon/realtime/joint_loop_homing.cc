// Homing and limit switches of a joint: JointLoop's methods around daemon/realtime/homing.h. Real-time safe.
#include "daemon/realtime/joint_loop.h"

namespace strainwave {

Homing::Observation JointLoop::observe(const CycleTime& time) const noexcept {
  return {reading().joint_position_rad, reading().inputs, motion_.at_target, time.now_ns,
          motion_.output.torque_Nm};
}

void JointLoop::obey_homing(const Homing::Order& order) noexcept {
  switch (order.kind) {
    case Homing::Order::Kind::kGoOn:
      return;
    case Homing::Order::Kind::kMove:
      controller_.set_target(order.target_rad, order.speed_rad_s);
      return;
    case Homing::Order::Kind::kStop:
      controller_.stop();
      return;
  }
}

Reason JointLoop::home(const CycleTime& time) noexcept {
  if (mode_.is(Mode::kFaulted)) return Reason::kFaulted;
  if (service_ == Service::kEnding) return Reason::kEnding;
  if (!homing_.possible()) return Reason::kNoHoming;
  if (!change_mode(ModeEvent::kHomeOrdered, time)) return Reason::kWrongMode;
  zero_.forget();
  yield_.reset();
  ordered_.forget();
  obey_homing(homing_.begin(observe(time)));
  return Reason::kAccepted;
}

void JointLoop::advance_homing(const CycleTime& time) noexcept {
  if (!mode_.is(Mode::kHoming)) return;
  if (watch_.fresh()) obey_homing(homing_.step(observe(time)));
  if (homing_.phase() == Homing::Phase::kFailed) raise_fault(Fault::kHomingFailed, time);
}

// Found, or told to hold: the joint holds as soon as it rests.
void JointLoop::end_homing(const CycleTime& time) noexcept {
  if (homing_.phase() == Homing::Phase::kDone) {
    zero_.set(homing_.found_rad(), config_.homing.home_position_rad);
    ordered_.rezero(zero_);
    (void)change_mode(ModeEvent::kArrived, time);
  } else if (homing_.phase() == Homing::Phase::kIdle && motion_.at_target) {
    (void)change_mode(ModeEvent::kArrived, time);
  }
}

bool JointLoop::into_limit_switch(double direction) const noexcept {
  return direction < 0.0 ? reading().inputs.negative_limit
                         : direction > 0.0 && reading().inputs.positive_limit;
}

// Homing goes into switches on purpose, slowly; its way to a stop needs the torque.
void JointLoop::refuse_torque_into_limit_switch() noexcept {
  if (mode_.is(Mode::kHoming) || !into_limit_switch(motion_.output.torque_Nm)) return;
  motion_.output.torque_Nm = 0.0;
  motion_.output.saturated = true;
}

}  // namespace strainwave
