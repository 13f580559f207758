// SPDX-License-Identifier: BSD-3-Clause
// Where the last accepted setpoint leads, and how long it is valid. A move has no end. A stream is begun by a setpoint that says
// so; each of its setpoints is valid for a while, and it ends when none follows, or by anything that ends motion. What comes of a
// stream that is not under way is refused, however late it comes. Real-time safe; time is an argument.
//
//   none -> live -> expired -> none      hold, stop, fault, enable, a move: live -> none
//   none -> path -> none                 its end, and whatever ends a stream
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "base/durations.h"
#include "daemon/realtime/joint/joint_zero.h"

namespace strainwave {

class OrderedTarget {
 public:
  /// How far a path has got.
  struct PathProgress {
    double time_s = 0.0;  ///< of the path's own
    bool paused = false;  ///< it rests until it is resumed
  };
  /// A setpoint as it was ordered.
  struct Setpoint {
    double joint_rad = 0.0;
    double drive_rad = 0.0;      ///< as the drive counts it
    std::int64_t stream_id = 0;  ///< 0: a move
    double valid_for_s = 0.0;    ///< of one of a stream
  };
  /// Whether a setpoint of `stream_id` may be obeyed: a move, the first of a stream, or the stream that is under way.
  bool takes(std::int64_t stream_id, bool begins) const noexcept {
    return stream_id == 0 || begins || (streamed() && stream_id == stream_id_);
  }
  void accept(const Setpoint& setpoint, std::int64_t now_ns) noexcept {
    joint_rad_ = setpoint.joint_rad;
    drive_rad_ = setpoint.drive_rad;
    stream_id_ = setpoint.stream_id;
    stream_ = setpoint.stream_id != 0 ? Stream::kLive : Stream::kNone;
    expires_ns_ = now_ns + nanoseconds(setpoint.valid_for_s);
  }
  /// True once, in the period in which a live stream has ended.
  bool expire(std::int64_t now_ns) noexcept {
    if (stream_ != Stream::kLive || now_ns < expires_ns_) return false;
    stream_ = Stream::kExpired;
    return true;
  }
  /// A path begins, which ends at `joint_rad`. It is not valid for a time: who follows it ends it.
  void begin_path(double joint_rad, double drive_rad) noexcept {
    joint_rad_ = joint_rad;
    drive_rad_ = drive_rad;
    stream_ = Stream::kPath;
    progress_ = {};
  }
  /// Of the path, as long as it lasts.
  void note(const PathProgress& progress) noexcept { progress_ = progress; }
  /// Something ends all motion: a live stream is over. That one has expired stays shown.
  void end() noexcept {
    if (goes_on()) stream_ = Stream::kNone;
  }
  /// Something else begins: nothing that was ordered is left.
  void forget() noexcept { *this = {}; }

  bool streamed() const noexcept { return stream_ == Stream::kLive; }
  /// Of the live stream; 0: none is.
  std::int64_t stream_id() const noexcept { return streamed() ? stream_id_ : 0; }
  bool on_path() const noexcept { return stream_ == Stream::kPath; }
  /// Nothing: the joint is on no path.
  std::optional<PathProgress> path() const noexcept {
    return on_path() ? std::optional(progress_) : std::nullopt;
  }
  /// A setpoint that rests is not the end.
  bool goes_on() const noexcept { return streamed() || on_path(); }
  /// Until the next setpoint is accepted.
  bool shows_expiry() const noexcept { return stream_ == Stream::kExpired; }
  /// Until the next setpoint is accepted: the stream's velocities ended it.
  void contradict() noexcept { stream_ = Stream::kContradicted; }
  bool contradicts() const noexcept { return stream_ == Stream::kContradicted; }
  /// The controller's target `drive_rad` on the joint side: to the bit the ordered one, so that a client recognises its order.
  double shown_rad(double drive_rad, const JointZero& zero) const noexcept {
    return drive_rad == drive_rad_ ? joint_rad_ : zero.to_joint_rad(drive_rad);
  }

 private:
  enum class Stream { kNone, kLive, kExpired, kContradicted, kPath };
  Stream stream_ = Stream::kNone;
  std::int64_t stream_id_ = 0;   ///< while live
  std::int64_t expires_ns_ = 0;  ///< while live
  double drive_rad_ = std::numeric_limits<double>::quiet_NaN();
  double joint_rad_ = 0.0;
  PathProgress progress_;  ///< while on a path
};

}  // namespace strainwave
