// The modes of a joint and what leads from one to another: a pure function with its table in one place. Real-time safe.
//
//   Off -> Starting -> Holding <-> Tracking -> Stopping -> Off, Holding <-> Homing, and Faulted from anywhere.
// Faulted is left only by an explicit clear, and only to Off: nothing resumes motion by itself.
#pragma once

#include <optional>

#include "lcmtypes/vocabulary.h"

namespace strainwave {

enum class ModeEvent {
  kEnableOrdered,     ///< a command to enable
  kDriveReady,        ///< the drive takes torque commands
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
  return mode == Mode::kStarting || mode == Mode::kHolding || mode == Mode::kTracking ||
         mode == Mode::kStopping || mode == Mode::kHoming;
}

/// True while the control law sets the torque.
constexpr bool is_controlled(Mode mode) noexcept {
  return wants_drive_enabled(mode) && mode != Mode::kStarting;
}

}  // namespace strainwave
