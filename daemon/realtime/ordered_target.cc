#include "daemon/realtime/ordered_target.h"

namespace strainwave {

namespace {
constexpr double kNanosecondsPerSecond = 1e9;
}

void OrderedTarget::accept(double joint_rad, double drive_rad, double valid_for_s,
                           std::int64_t now_ns) noexcept {
  joint_rad_ = joint_rad;
  drive_rad_ = drive_rad;
  stream_ = valid_for_s > 0.0 ? Stream::kLive : Stream::kNone;
  expires_ns_ = now_ns + static_cast<std::int64_t>(valid_for_s * kNanosecondsPerSecond);
}

bool OrderedTarget::expire(std::int64_t now_ns) noexcept {
  if (stream_ != Stream::kLive || now_ns < expires_ns_) return false;
  stream_ = Stream::kExpired;
  return true;
}

void OrderedTarget::hold() noexcept {
  if (stream_ == Stream::kLive) stream_ = Stream::kNone;
  if (stream_ == Stream::kExpired) stream_ = Stream::kReleased;
}

}  // namespace strainwave
