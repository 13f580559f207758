// SPDX-License-Identifier: BSD-3-Clause
// What the joint is ordered to do, as one reference: a move to a target, a path, a stream, or coming to rest. Each replaces the other in
// mid-motion without a jump of position or velocity. Real-time safe; time is counted in periods. Joint side, SI.
//
//   move     -> ReferenceShaper to the target           time-optimal under the limits of now
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

  /// Comes to rest from here and stays.
  void start(double position_rad, double velocity_rad_s) noexcept;
  /// Goes on from here to what was ordered: a joint that stands beside its place, or that moved while the loop did not run.
  void go_on_from(double position_rad, double velocity_rad_s = 0.0) noexcept {
    shaper_.restart(position_rad, velocity_rad_s);
  }
  void set_target(double position_rad) noexcept;
  SampleFate follow(const StreamSample& sample, bool begins, double lead_periods, const MotionLimits& reach,
                    const PositionRange& range) noexcept;
  /// A path is here in so many periods, > 0.
  void follow_path(double position_rad, double velocity_rad_s, std::int64_t in_periods,
                   const PositionRange& range) noexcept;
  void stop() noexcept;

  /// So many periods, >= 1, after the last step() comes the next: before samples that have come since are followed.
  void begin_period(std::int64_t elapsed_periods) noexcept;
  /// The reference for this period, within `limits`.
  Reference step(const MotionLimits& limits) noexcept;

  /// A target is ordered, or where a stop ends; of a stream its last sample.
  double target_rad() const noexcept { return streamed() ? sample_rad_ : shaper_.target_rad(); }
  /// Where the reference is to end as far as is known: of a stream its target of this period.
  double present_target_rad() const noexcept { return shaper_.target_rad(); }
  bool rests() const noexcept { return shaper_.at_target(); }
  double position_rad() const noexcept { return shaper_.position_rad(); }
  double velocity_rad_s() const noexcept { return shaper_.velocity_rad_s(); }
  bool streamed() const noexcept { return source_ != Source::kMove; }
  /// The stream is elsewhere: the limits do not let the reference be there, or not yet.
  bool off_stream() const noexcept;
  bool ran_out_of_samples() const noexcept { return stream_.ended(); }
  /// Of the last two samples, see StreamBuffer.
  double velocity_ratio() const noexcept { return stream_.velocity_ratio(); }
  /// What the stream says of its load, and what the last one said until take_load().
  const StreamLoad& load() const noexcept { return load_; }
  /// The stream is over: the torque that it had named.
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
  Reference on_path_;  ///< now
  PathKnot path_to_;   ///< its next knot, from now
};

}  // namespace strainwave
