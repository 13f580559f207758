// SPDX-License-Identifier: BSD-3-Clause
// The target of the last accepted setpoint, and its validity. A move does not expire. A stream begins with a setpoint that says so.
// Each of its setpoints is valid for a while; the stream ends if none follows, or with anything that ends motion. Setpoints of a
// stream that is not live are refused, however late they arrive. Real-time safe; time is an argument.
//
//   none -> live -> expired -> none      hold, stop, fault, enable, a move: live -> none
//   none -> path -> none                 at its end, and by anything that ends a stream
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "base/durations.h"
#include "daemon/realtime/joint/joint_zero.h"

namespace strainwave {

class OrderedTarget {
 public:
  /// The progress on a path.
  struct PathProgress {
    double time_s = 0.0;  ///< in the path's own time
    bool paused = false;  ///< the path rests until it is resumed
  };
  /// A setpoint as it was ordered.
  struct Setpoint {
    double joint_rad = 0.0;
    double drive_rad = 0.0;      ///< as the drive counts it
    std::int64_t stream_id = 0;  ///< 0: a move
    double valid_for_s = 0.0;    ///< for a setpoint of a stream
  };
  /// Whether a setpoint of `stream_id` may be obeyed: a move, the first of a stream, or one of the live stream.
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
  /// True once, in the period in which a live stream expires.
  bool expire(std::int64_t now_ns) noexcept {
    if (stream_ != Stream::kLive || now_ns < expires_ns_) return false;
    stream_ = Stream::kExpired;
    return true;
  }
  /// Begins a path that ends at `joint_rad`. It does not expire: the path follower ends it.
  void begin_path(double joint_rad, double drive_rad) noexcept {
    joint_rad_ = joint_rad;
    drive_rad_ = drive_rad;
    stream_ = Stream::kPath;
    progress_ = {};
  }
  /// Stores the progress on the path.
  void note(const PathProgress& progress) noexcept { progress_ = progress; }
  /// Ends a live stream or path, because all motion ends. An expired stream stays shown.
  void end() noexcept {
    if (goes_on()) stream_ = Stream::kNone;
  }
  /// Forgets all orders, because another motion begins.
  void forget() noexcept { *this = {}; }

  bool streamed() const noexcept { return stream_ == Stream::kLive; }
  /// The live stream; 0: none.
  std::int64_t stream_id() const noexcept { return streamed() ? stream_id_ : 0; }
  bool on_path() const noexcept { return stream_ == Stream::kPath; }
  /// None if the joint is on no path.
  std::optional<PathProgress> path() const noexcept {
    return on_path() ? std::optional(progress_) : std::nullopt;
  }
  /// Whether a stream or path continues, even if its setpoint rests.
  bool goes_on() const noexcept { return streamed() || on_path(); }
  /// Whether a stream has expired, until the next setpoint is accepted.
  bool shows_expiry() const noexcept { return stream_ == Stream::kExpired; }
  /// Ends a stream because of its velocities; shown until the next setpoint is accepted.
  void contradict() noexcept { stream_ = Stream::kContradicted; }
  bool contradicts() const noexcept { return stream_ == Stream::kContradicted; }
  /// The controller's target `drive_rad` as a joint position. An ordered target is returned exactly, so that a client recognises its order.
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
