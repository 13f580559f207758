// SPDX-License-Identifier: BSD-3-Clause
// A joint's mode, how long it has lasted, and the fault that is latched in it: daemon/realtime/mode_machine.h with a memory.
// Real-time safe; time is an argument.
#pragma once

#include <cstdint>

#include "base/durations.h"
#include "daemon/realtime/mode_machine.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

class JointMode {
 public:
  /// False, and nothing changes, when `event` means nothing in this mode. For all events but kFaultRaised.
  bool apply(ModeEvent event, std::int64_t now_ns) noexcept;
  /// Latches `fault` with the drive's own number for it. The first fault stays: false when one is latched already.
  bool latch(Fault fault, std::uint32_t drive_error, std::int64_t now_ns) noexcept;

  Mode mode() const noexcept { return mode_; }
  bool is(Mode mode) const noexcept { return mode_ == mode; }
  /// True while the control law sets the torque.
  bool controlled() const noexcept { return is_controlled(mode_); }
  /// kNone unless faulted.
  Fault fault() const noexcept { return fault_; }
  /// What the drive said when the last fault came.
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
