#include "control/trajectory/trajectory.h"

#include <algorithm>
#include <cmath>

#include "control/joint/joint_measurement.h"

namespace strainwave {

namespace {

// A reading that flickers does so by one count, and by rounding.
constexpr double kFlickerCounts = 1.5;
// Farther than this from the stream a reference is off it: a tenth of a count of a fine encoder.
constexpr double kOnStream_rad = 1e-6;

}  // namespace

void Trajectory::start(double position_rad, double velocity_rad_s) noexcept {
  shaper_.reset(position_rad, velocity_rad_s);
  streamed_ = false;
  load_ = {};
}

void Trajectory::set_target(double position_rad) noexcept {
  streamed_ = false;
  shaper_.set_target(position_rad);
}

void Trajectory::follow(const StreamSample& sample, bool begins, double lead_periods,
                        const MotionLimits& reach, const PositionRange& range) noexcept {
  range_ = range;
  if (!streamed_ || begins) {
    const bool resumes = !begins && stream_.ended() && stream_.lead_periods() == lead_periods;
    if (resumes)
      stream_.resume(shaper_.position_rad(), shaper_.velocity_rad_s(), load_);
    else
      stream_.begin(shaper_.position_rad(), shaper_.velocity_rad_s(), lead_periods, load_);
  }
  streamed_ = true;
  exact_ = sample.computed_here;
  sample_rad_ = sample.position_rad;
  stream_.take(sample,
               {reach.velocity_rad_s, std::min(reach.acceleration_rad_s2, reach.deceleration_rad_s2)});
}

void Trajectory::stop() noexcept {
  streamed_ = false;
  shaper_.stop();
}

// Through periods that were left out step() goes as if it had been called; not where the joint's motion is unknown.
void Trajectory::begin_period(std::int64_t elapsed_periods) noexcept {
  if (elapsed_periods <= kMaxElapsedPeriods)
    stream_.leave_out(elapsed_periods - 1);
  else if (streamed_)
    stream_.skip(elapsed_periods - 1);
  else
    stream_.wait(elapsed_periods - 1);
}

bool Trajectory::off_stream() const noexcept {
  return streamed_ && std::abs(shaper_.target_rad() - shaper_.position_rad()) > kOnStream_rad;
}

// A stream that stands may flicker by an encoder's count: a reference that rests does not follow it.
bool Trajectory::flickers(const MovingTarget& target) const noexcept {
  return !exact_ && shaper_.velocity_rad_s() == 0.0 &&
         std::abs(target.next_position_rad - shaper_.position_rad()) <= kFlickerCounts * count_rad_;
}

Reference Trajectory::step(const MotionLimits& limits) noexcept {
  shaper_.set_limits(limits);
  if (!streamed_) {
    stream_.wait(1);
    return shaper_.step();
  }
  MovingTarget target = stream_.step();
  load_ = target.load;
  if (flickers(target)) target = {shaper_.position_rad(), 0.0, shaper_.position_rad(), 0.0, target.load};
  const Reference reference = shaper_.follow(target, range_);
  if (stream_.ended()) stop();
  return reference;
}

}  // namespace strainwave
