// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/trajectory.h"

#include <algorithm>
#include <cmath>

#include "control/joint/joint_measurement.h"

namespace strainwave {

namespace {

// A flickering reading changes by one count, and by rounding.
constexpr double kFlickerCounts = 1.5;
// A reference farther than this from the stream is off it: a tenth of a count of a fine encoder.
constexpr double kOnStream_rad = 1e-6;

}  // namespace

void Trajectory::start(double position_rad, double velocity_rad_s) noexcept {
  shaper_.reset(position_rad, velocity_rad_s);
  source_ = Source::kMove;
  load_ = {};
}

void Trajectory::set_target(double position_rad) noexcept {
  source_ = Source::kMove;
  shaper_.set_target(position_rad);
}

SampleFate Trajectory::follow(const StreamSample& sample, bool begins, double lead_periods,
                              const MotionLimits& reach, const PositionRange& range) noexcept {
  range_ = range;
  const bool ended = stream_.ended() && stream_.lead_periods() == lead_periods;
  if (begins || (source_ != Source::kStream && !ended))
    stream_.begin(shaper_.position_rad(), shaper_.velocity_rad_s(), lead_periods, load_);
  else if (source_ != Source::kStream)
    stream_.resume(shaper_.position_rad(), shaper_.velocity_rad_s(), load_);
  source_ = Source::kStream;
  sample_rad_ = sample.position_rad;
  return stream_.take(sample, reach);
}

void Trajectory::follow_path(double position_rad, double velocity_rad_s, std::int64_t in_periods,
                             const PositionRange& range) noexcept {
  range_ = range;
  if (source_ != Source::kPath) on_path_ = {shaper_.position_rad(), shaper_.velocity_rad_s(), 0.0};
  source_ = Source::kPath;
  sample_rad_ = position_rad;
  path_to_ = {config_.period_s * static_cast<double>(in_periods), position_rad, velocity_rad_s};
}

void Trajectory::stop() noexcept {
  source_ = Source::kMove;
  shaper_.stop();
}

// For skipped periods step() is still called, except after a gap that makes the motion of the joint unknown.
void Trajectory::begin_period(std::int64_t elapsed_periods) noexcept {
  if (elapsed_periods <= kMaxElapsedPeriods) return stream_.leave_out(elapsed_periods - 1);
  stream_.wait(elapsed_periods - 1);
  if (source_ == Source::kStream) stream_.catch_up();
}

bool Trajectory::off_stream() const noexcept {
  return streamed() && std::abs(shaper_.target_rad() - shaper_.position_rad()) > kOnStream_rad;
}

// A stream at standstill may flicker by an encoder's count. A reference at rest does not follow that.
bool Trajectory::flickers(const MovingTarget& target) const noexcept {
  return shaper_.velocity_rad_s() == 0.0 &&
         std::abs(target.next_position_rad - shaper_.position_rad()) <= kFlickerCounts * config_.count_rad;
}

// Follows the cubic to the path's next knot. If no further knot arrives, the path rests there.
MovingTarget Trajectory::next_on_path() noexcept {
  const PathKnot now{0.0, on_path_.position_rad, on_path_.velocity_rad_s};
  const PathKnot& to = path_to_;
  Reference next{to.position_rad, to.time_s > 0.5 * config_.period_s ? to.velocity_rad_s : 0.0, 0.0};
  if (to.time_s > 1.5 * config_.period_s) next = on_cubic(now, to, config_.period_s);
  path_to_.time_s = std::max(0.0, to.time_s - config_.period_s);
  on_path_ = next;
  return {now.position_rad, now.velocity_rad_s, next.position_rad, next.velocity_rad_s};
}

Reference Trajectory::step(const MotionLimits& limits) noexcept {
  shaper_.set_limits(limits);
  if (source_ != Source::kStream) stream_.wait(1);
  if (source_ == Source::kMove) return shaper_.step();
  if (source_ == Source::kPath) return shaper_.follow(next_on_path(), range_);
  MovingTarget target = stream_.step();
  load_ = target.load;
  if (flickers(target)) target = {shaper_.position_rad(), 0.0, shaper_.position_rad(), 0.0, target.load};
  const Reference reference = shaper_.follow(target, range_);
  if (stream_.ended()) stop();
  return reference;
}

}  // namespace strainwave
