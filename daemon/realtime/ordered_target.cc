// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/ordered_target.h"

#include "base/durations.h"

namespace strainwave {

void OrderedTarget::accept(const Setpoint& setpoint, std::int64_t now_ns) noexcept {
  joint_rad_ = setpoint.joint_rad;
  drive_rad_ = setpoint.drive_rad;
  stream_id_ = setpoint.stream_id;
  stream_ = setpoint.stream_id != 0 ? Stream::kLive : Stream::kNone;
  expires_ns_ = now_ns + nanoseconds(setpoint.valid_for_s);
}

bool OrderedTarget::expire(std::int64_t now_ns) noexcept {
  if (stream_ != Stream::kLive || now_ns < expires_ns_) return false;
  stream_ = Stream::kExpired;
  return true;
}

}  // namespace strainwave
