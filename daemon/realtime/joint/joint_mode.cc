// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/joint_mode.h"

#include <array>
#include <cassert>

namespace strainwave {

namespace {

struct Transition {
  Mode from;
  ModeEvent event;
  Mode to;
};

// In addition, a fault leads to Faulted from every mode.
constexpr std::array kTransitions{
    Transition{Mode::kOff, ModeEvent::kEnableOrdered, Mode::kStarting},
    Transition{Mode::kOff, ModeEvent::kDisableOrdered, Mode::kOff},
    Transition{Mode::kStarting, ModeEvent::kDriveReady, Mode::kHolding},
    Transition{Mode::kStarting, ModeEvent::kTorqueReady, Mode::kReleasing},
    Transition{Mode::kStarting, ModeEvent::kDisableOrdered, Mode::kOff},
    Transition{Mode::kReleasing, ModeEvent::kDriveReady, Mode::kHolding},
    Transition{Mode::kReleasing, ModeEvent::kDisableOrdered, Mode::kStopping},
    Transition{Mode::kHolding, ModeEvent::kSetpointAccepted, Mode::kTracking},
    Transition{Mode::kHolding, ModeEvent::kHomeOrdered, Mode::kHoming},
    Transition{Mode::kHolding, ModeEvent::kDisableOrdered, Mode::kStopping},
    Transition{Mode::kTracking, ModeEvent::kSetpointAccepted, Mode::kTracking},
    Transition{Mode::kTracking, ModeEvent::kArrived, Mode::kHolding},
    Transition{Mode::kTracking, ModeEvent::kDisableOrdered, Mode::kStopping},
    Transition{Mode::kHoming, ModeEvent::kArrived, Mode::kHolding},
    Transition{Mode::kHoming, ModeEvent::kDisableOrdered, Mode::kStopping},
    Transition{Mode::kStopping, ModeEvent::kDisableOrdered, Mode::kStopping},
    Transition{Mode::kStopping, ModeEvent::kStopped, Mode::kOff},
    Transition{Mode::kFaulted, ModeEvent::kDisableOrdered, Mode::kFaulted},
    Transition{Mode::kFaulted, ModeEvent::kFaultCleared, Mode::kOff},
};

}  // namespace

std::optional<Mode> next_mode(Mode mode, ModeEvent event) noexcept {
  for (const Transition& transition : kTransitions)
    if (transition.from == mode && transition.event == event) return transition.to;
  return std::nullopt;
}

bool JointMode::apply(ModeEvent event, std::int64_t now_ns) noexcept {
  const auto next = next_mode(mode_, event);
  if (!next) return false;
  enter(*next, now_ns);
  return true;
}

bool JointMode::latch(Fault fault, std::uint32_t drive_error, std::int64_t now_ns) noexcept {
  assert(fault != Fault::kNone);
  if (is(Mode::kFaulted)) return false;
  enter(Mode::kFaulted, now_ns);
  fault_ = fault;
  drive_error_ = drive_error;
  ++faults_total_;
  return true;
}

void JointMode::enter(Mode mode, std::int64_t now_ns) noexcept {
  if (mode == mode_) return;
  mode_ = mode;
  since_ns_ = now_ns;
  fault_ = Fault::kNone;
}

}  // namespace strainwave
