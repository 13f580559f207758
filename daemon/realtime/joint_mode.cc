// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint_mode.h"

#include <cassert>

namespace strainwave {

bool JointMode::apply(ModeEvent event, std::int64_t now_ns) noexcept {
  assert(event != ModeEvent::kFaultRaised);
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
