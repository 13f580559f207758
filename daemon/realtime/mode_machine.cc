// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/mode_machine.h"

#include <array>

namespace strainwave {

namespace {

struct Transition {
  Mode from;
  ModeEvent event;
  Mode to;
};

// kFaultRaised leads to Faulted from every mode and is not repeated here.
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
  if (event == ModeEvent::kFaultRaised) return Mode::kFaulted;
  for (const Transition& transition : kTransitions)
    if (transition.from == mode && transition.event == event) return transition.to;
  return std::nullopt;
}

}  // namespace strainwave
