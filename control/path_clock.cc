#include "control/path_clock.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// Slower than this share of its limit a joint does not matter to the rate.
constexpr double kStands = 1e-9;

RateRoom room_at(const PathPoint& point, double rate, const MotionLimits& limits) noexcept {
  const double speed_rad_s = std::abs(point.velocity_rad_s);
  if (speed_rad_s <= kStands * limits.velocity_rad_s) return PathClock::kMostRoom;
  const double along_rad_s2 =
      std::copysign(1.0, point.velocity_rad_s) * point.acceleration_rad_s2 * rate * rate;
  return {std::max(0.0, (limits.deceleration_rad_s2 + along_rad_s2) / speed_rad_s),
          std::max(0.0, (limits.acceleration_rad_s2 - along_rad_s2) / speed_rad_s)};
}

}  // namespace

RateRoom RateRoom::both(const RateRoom& other) const noexcept {
  return {std::min(falling_1_s, other.falling_1_s), std::min(rising_1_s, other.rising_1_s)};
}

RateRoom rate_room(const PathPoint& here, const PathPoint& next, double rate,
                   const MotionLimits& limits) noexcept {
  return room_at(here, rate, limits).both(room_at(next, rate, limits));
}

void PathClock::advance(double period_s, const RateRoom& room) noexcept {
  const RateRoom allowed = room.both(kMostRoom);
  const double before = rate_;
  rate_ += std::clamp(wanted() - rate_, -period_s * allowed.falling_1_s, period_s * allowed.rising_1_s);
  change_1_s_ = (rate_ - before) / period_s;
  time_s_ += 0.5 * period_s * (before + rate_);
}

PathPoint in_clock_time(const PathPoint& point, const PathClock& clock) noexcept {
  const double r = clock.rate();
  return {point.position_rad, point.velocity_rad_s * r,
          point.acceleration_rad_s2 * r * r + point.velocity_rad_s * clock.rate_change_1_s()};
}

}  // namespace strainwave
