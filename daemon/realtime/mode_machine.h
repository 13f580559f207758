// SPDX-License-Identifier: BSD-3-Clause
// The modes of a joint and what leads from one to another: a pure function with its table in one place. Real-time safe.
//
//   Off -> Starting -> (Releasing ->) Holding <-> Tracking -> Stopping -> Off, Holding <-> Homing, and Faulted from anywhere.
// Releasing: the position is held under torque while the brake opens; no motion is accepted before it is open.
// Faulted is left only by an explicit clear, and only to Off: nothing resumes motion by itself.
#pragma once

#include <optional>

#include "strainwave/vocabulary.h"

namespace strainwave {

enum class ModeEvent {
  kEnableOrdered,     ///< a command to enable
  kTorqueReady,       ///< the drive takes torque commands, its brake is shut
  kDriveReady,        ///< the drive takes torque commands, and nothing else holds the joint
  kSetpointAccepted,  ///< a move or a stream begins or goes on
  kHomeOrdered,       ///< a command to find the home position
  kArrived,           ///< the reference rests at its end; after kHomeOrdered: where homing ended
  kDisableOrdered,    ///< a command to disable, or the end of the daemon
  kStopped,           ///< the joint stands still after kDisableOrdered
  kFaultRaised,
  kFaultCleared,  ///< a command to clear
};

/// The mode after `event`, or nothing when the event means nothing in this mode (a command is then refused).
std::optional<Mode> next_mode(Mode mode, ModeEvent event) noexcept;

/// True while the drive is to be enabled.
constexpr bool wants_drive_enabled(Mode mode) noexcept {
  return mode != Mode::kOff && mode != Mode::kFaulted;
}

/// True while the control law sets the torque.
constexpr bool is_controlled(Mode mode) noexcept {
  return wants_drive_enabled(mode) && mode != Mode::kStarting;
}

}  // namespace strainwave
