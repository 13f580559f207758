// SPDX-License-Identifier: BSD-3-Clause
// The modes of a joint and their transitions. JointMode holds a joint's present mode, its duration and the latched fault. Real-time
// safe; time is an argument.
//
//   Off -> Starting -> (Releasing ->) Holding <-> Tracking -> Stopping -> Off, Holding <-> Homing, and Faulted from anywhere.
// Releasing: the position is held under torque while the brake opens; no motion is accepted before it is open.
// Faulted is left only by an explicit clear, and only to Off: nothing resumes motion by itself.
#pragma once

#include <cstdint>
#include <optional>

#include "base/durations.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

enum class ModeEvent {
  kEnableOrdered,     ///< a command to enable
  kTorqueReady,       ///< the drive takes torque commands, but its brake is shut
  kDriveReady,        ///< the drive takes torque commands, and nothing else holds the joint
  kSetpointAccepted,  ///< a move or a stream begins or goes on
  kHomeOrdered,       ///< a command to find the home position
  kArrived,           ///< the reference rests at its end; after kHomeOrdered: where homing ended
  kDisableOrdered,    ///< a command to disable, or the end of the daemon
  kStopped,           ///< the joint stands still after kDisableOrdered
  kFaultCleared,      ///< a command to clear
};

/// The mode after `event`, or nothing when the event is not allowed in this mode (a command is then refused).
std::optional<Mode> next_mode(Mode mode, ModeEvent event) noexcept;

/// True while the drive is to be enabled.
constexpr bool wants_drive_enabled(Mode mode) noexcept {
  return mode != Mode::kOff && mode != Mode::kFaulted;
}

/// True while the control law sets the torque.
constexpr bool is_controlled(Mode mode) noexcept {
  return wants_drive_enabled(mode) && mode != Mode::kStarting;
}

class JointMode {
 public:
  /// Returns false and changes nothing when `event` is not allowed in this mode.
  bool apply(ModeEvent event, std::int64_t now_ns) noexcept;
  /// Latches `fault` with its error number. The first fault stays: false when one is latched already.
  bool latch(Fault fault, std::uint32_t drive_error, std::int64_t now_ns) noexcept;

  Mode mode() const noexcept { return mode_; }
  bool is(Mode mode) const noexcept { return mode_ == mode; }
  /// True while the control law sets the torque.
  bool controlled() const noexcept { return is_controlled(mode_); }
  /// kNone unless faulted.
  Fault fault() const noexcept { return fault_; }
  /// The error number of the last fault.
  std::uint32_t drive_error() const noexcept { return drive_error_; }
  std::int64_t faults_total() const noexcept { return faults_total_; }

  double seconds(std::int64_t now_ns) const noexcept { return strainwave::seconds(now_ns - since_ns_); }
  /// Whether the mode began in the period of `now_ns`.
  bool began(std::int64_t now_ns) const noexcept { return since_ns_ == now_ns; }

 private:
  void enter(Mode mode, std::int64_t now_ns) noexcept;

  Mode mode_ = Mode::kOff;
  Fault fault_ = Fault::kNone;
  std::uint32_t drive_error_ = 0;
  std::int64_t since_ns_ = 0;
  std::int64_t faults_total_ = 0;
};

}  // namespace strainwave
