// Where the last accepted setpoint leads, and how long it is valid. A move has no end; each setpoint of a stream is valid for a
// while, and a stream that falls silent expires: the joint comes to rest, and late packets of it are refused until somebody
// says that something new begins. Real-time safe; time is an argument.
//
//   none -> live -> expired -> released -> none      a hold releases; any other new beginning forgets
//                   (refused, shown)  (shown)
#pragma once

#include <cstdint>

#include "daemon/realtime/joint_zero.h"

namespace strainwave {

class OrderedTarget {
 public:
  /// The setpoint `joint_rad`, which the drive counts as `drive_rad`; `valid_for_s` > 0 for one of a stream, 0 for a move.
  void accept(double joint_rad, double drive_rad, double valid_for_s, std::int64_t now_ns) noexcept;
  /// True once, in the period in which a live stream has ended.
  bool expire(std::int64_t now_ns) noexcept;
  /// An order to hold: ends a live stream; after an expired one a new one may begin.
  void hold() noexcept;
  /// Something else begins: nothing of a stream is left.
  void forget() noexcept { stream_ = Stream::kNone; }
  /// Homing has moved the zero.
  void rezero(const JointZero& zero) noexcept { joint_rad_ = zero.to_joint_rad(drive_rad_); }

  bool streamed() const noexcept { return stream_ == Stream::kLive; }
  /// False while only late packets of an expired stream can be meant.
  bool takes_stream() const noexcept { return stream_ != Stream::kExpired; }
  /// Until the next setpoint is accepted.
  bool shows_expiry() const noexcept { return stream_ == Stream::kExpired || stream_ == Stream::kReleased; }
  /// The target `drive_rad` of the controller at the joint: to the bit what was ordered, so that whoever ordered it knows it
  /// again.
  double shown_rad(double drive_rad, const JointZero& zero) const noexcept {
    return drive_rad == drive_rad_ ? joint_rad_ : zero.to_joint_rad(drive_rad);
  }

 private:
  enum class Stream { kNone, kLive, kExpired, kReleased };
  Stream stream_ = Stream::kNone;
  std::int64_t expires_ns_ = 0;  ///< while live
  double drive_rad_ = 0.0;
  double joint_rad_ = 0.0;
};

}  // namespace strainwave
