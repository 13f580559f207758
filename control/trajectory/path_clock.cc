// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/path_clock.h"

#include <algorithm>
#include <cmath>

#include "base/printable.h"

namespace strainwave {

namespace {

RateRoom room_at(const Reference& point, double rate, const MotionLimits& limits) noexcept {
  const double speed_rad_s = std::abs(point.velocity_rad_s);
  // A joint this slow does not limit the rate.
  if (speed_rad_s <= kAtBound * limits.velocity_rad_s) return PathClock::kMostRoom;
  const double along_rad_s2 =
      std::copysign(1.0, point.velocity_rad_s) * point.acceleration_rad_s2 * rate * rate;
  return {std::max(0.0, (limits.deceleration_rad_s2 + along_rad_s2) / speed_rad_s),
          std::max(0.0, (limits.acceleration_rad_s2 - along_rad_s2) / speed_rad_s)};
}

}  // namespace

RateRoom RateRoom::both(const RateRoom& other) const noexcept {
  return {std::min(falling_1_s, other.falling_1_s), std::min(rising_1_s, other.rising_1_s)};
}

RateRoom rate_room(const Reference& here, const Reference& next, double rate,
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

void PathTimes::note(const PathTime& now) noexcept {
  last_ = (last_ + 1) % kPeriods;
  times_[last_] = now;
}

PathTime PathTimes::ago(double periods) const noexcept {
  const double whole = std::floor(std::clamp(periods, 0.0, static_cast<double>(kPeriods - 2)));
  const double share = std::clamp(periods - whole, 0.0, 1.0);
  const std::size_t newer_at = last_ + kPeriods - static_cast<std::size_t>(whole);
  const PathTime& newer = times_[newer_at % kPeriods];
  const PathTime& older = times_[(newer_at - 1) % kPeriods];
  const auto between = [share](double now, double before) { return now + share * (before - now); };
  return {between(newer.time_s, older.time_s), between(newer.rate, older.rate),
          between(newer.rate_change_1_s, older.rate_change_1_s)};
}

Reference in_path_time(const Reference& point, const PathTime& time) noexcept {
  const double r = time.rate;
  return {point.position_rad, point.velocity_rad_s * r,
          point.acceleration_rad_s2 * r * r + point.velocity_rad_s * time.rate_change_1_s};
}

}  // namespace strainwave
