// What the joint is ordered to do, as one reference: a move to a target, a path, a stream, or coming to rest. Each replaces the other in
// mid-motion without a jump of position or velocity. Real-time safe; time is counted in periods. Joint side, SI.
//
//   move     -> ReferenceShaper to the target           time-optimal under the limits of now
//   stream   -> StreamTarget -> ReferenceShaper         on the stream as soon as the limits allow
//   path     -> likewise, with samples for every period that are exact
//   stop     -> ReferenceShaper to rest
#pragma once

#include <cstdint>
#include <utility>

#include "control/trajectory/reference_shaper.h"
#include "control/trajectory/stream_target.h"

namespace strainwave {

/// What is where a stream is at a sample's time: the joint, or the plan, which the joint follows later.
enum class OnTime { kJoint, kPlan };

class Trajectory {
 public:
  /// `period_s` > 0; `bridge_s` >= 0: how long a stream goes on without samples; `count_rad` > 0: what an encoder cannot tell.
  Trajectory(double period_s, double bridge_s, double count_rad) noexcept
      : count_rad_(count_rad), shaper_(period_s), stream_(period_s, bridge_s) {}

  /// Comes to rest from here and stays.
  void start(double position_rad, double velocity_rad_s) noexcept;
  /// Goes on from here to what was ordered: a joint that stands beside its place, or that moved while the loop did not run.
  void go_on_from(double position_rad, double velocity_rad_s = 0.0) noexcept {
    shaper_.restart(position_rad, velocity_rad_s);
  }
  void set_target(double position_rad) noexcept;
  void follow(const StreamSample& sample, bool begins, double lead_periods, const MotionLimits& reach,
              const PositionRange& range) noexcept;
  void stop() noexcept;

  /// So many periods, >= 1, after the last step() comes the next: before samples that have come since are followed.
  void begin_period(std::int64_t elapsed_periods) noexcept;
  /// The reference for this period, within `limits`.
  Reference step(const MotionLimits& limits) noexcept;

  /// A target is ordered, or where a stop ends; of a stream its last sample.
  double target_rad() const noexcept { return streamed_ ? sample_rad_ : shaper_.target_rad(); }
  /// Where the reference is to end as far as is known: of a stream its target of this period.
  double present_target_rad() const noexcept { return shaper_.target_rad(); }
  bool rests() const noexcept { return shaper_.at_target(); }
  double position_rad() const noexcept { return shaper_.position_rad(); }
  double velocity_rad_s() const noexcept { return shaper_.velocity_rad_s(); }
  bool streamed() const noexcept { return streamed_; }
  /// The stream is elsewhere: the limits do not let the reference be there, or not yet.
  bool off_stream() const noexcept;
  bool ran_out_of_samples() const noexcept { return stream_.ended(); }
  /// What the stream says of its load, and what the last one said until take_load().
  const ToldLoad& load() const noexcept { return load_; }
  /// The stream is over: the torque that it had named.
  double take_load_Nm() noexcept { return std::exchange(load_, {}).torque_Nm; }

 private:
  bool flickers(const MovingTarget& target) const noexcept;

  double count_rad_;
  ReferenceShaper shaper_;
  StreamTarget stream_;
  PositionRange range_;
  ToldLoad load_;
  double sample_rad_ = 0.0;
  bool streamed_ = false;
  bool exact_ = false;  ///< a path
};

}  // namespace strainwave
