// SPDX-License-Identifier: BSD-3-Clause
// The ordered motion of a joint as one reference: a move to a target, a path, a stream, or coming to rest. A new order replaces the old one
// during a motion, without a jump of position or velocity. Real-time safe; time is counted in periods. Joint side, SI.
//
//   move     -> ReferenceShaper to the target           time-optimal under the present limits
//   stream   -> StreamBuffer -> ReferenceShaper         on the stream as soon as the limits allow
//   path     -> a cubic from period to period -> ReferenceShaper
//   stop     -> ReferenceShaper to rest
#pragma once

#include <cstdint>
#include <utility>

#include "control/trajectory/knot_path.h"
#include "control/trajectory/reference_shaper.h"
#include "control/trajectory/stream_buffer.h"

namespace strainwave {

class Trajectory {
 public:
  explicit Trajectory(const StreamConfig& config) noexcept
      : config_(config), shaper_(config.period_s), stream_(config) {}

  /// Decelerates to rest from here and stays.
  void start(double position_rad, double velocity_rad_s) noexcept;
  /// Continues from here to the ordered target, for a joint that stands off its target, or moved while the loop did not run.
  void go_on_from(double position_rad, double velocity_rad_s = 0.0) noexcept {
    shaper_.restart(position_rad, velocity_rad_s);
  }
  void set_target(double position_rad) noexcept;
  SampleFate follow(const StreamSample& sample, bool begins, double lead_periods, const MotionLimits& reach,
                    const PositionRange& range) noexcept;
  /// A path reaches this point in `in_periods` > 0.
  void follow_path(double position_rad, double velocity_rad_s, std::int64_t in_periods,
                   const PositionRange& range) noexcept;
  void stop() noexcept;

  /// The next step() comes `elapsed_periods` >= 1 after the last one. Call this before follow() of samples that have arrived since.
  void begin_period(std::int64_t elapsed_periods) noexcept;
  /// The reference for this period, within `limits`.
  Reference step(const MotionLimits& limits) noexcept;

  /// The ordered target, or where a stop ends; the newest sample of a stream or path.
  double target_rad() const noexcept { return streamed() ? sample_rad_ : shaper_.target_rad(); }
  /// The end of the reference, as far as known; this period's target of a stream or path.
  double present_target_rad() const noexcept { return shaper_.target_rad(); }
  bool rests() const noexcept { return shaper_.at_target(); }
  double position_rad() const noexcept { return shaper_.position_rad(); }
  double velocity_rad_s() const noexcept { return shaper_.velocity_rad_s(); }
  bool streamed() const noexcept { return source_ != Source::kMove; }
  /// Whether the reference is off the stream: the limits keep it off, or it is still approaching.
  bool off_stream() const noexcept;
  bool ran_out_of_samples() const noexcept { return stream_.ended(); }
  /// See StreamBuffer.
  double velocity_ratio() const noexcept { return stream_.velocity_ratio(); }
  /// Load that the stream names. After the stream it stays until take_load_Nm().
  const StreamLoad& load() const noexcept { return load_; }
  /// Returns the torque of a stream that is over, and clears the load.
  double take_load_Nm() noexcept { return std::exchange(load_, {}).torque_Nm; }

 private:
  enum class Source { kMove, kStream, kPath };
  bool flickers(const MovingTarget& target) const noexcept;
  MovingTarget next_on_path() noexcept;

  StreamConfig config_;
  ReferenceShaper shaper_;
  StreamBuffer stream_;
  PositionRange range_;
  StreamLoad load_;
  double sample_rad_ = 0.0;
  Source source_ = Source::kMove;
  Reference on_path_;  ///< the present point of the path
  PathKnot path_to_;   ///< the next point of the path, with the time until then
};

}  // namespace strainwave
