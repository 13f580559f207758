#include "control/jerk_limit.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// Rounding makes no period of its own.
int width_periods(double width_s, double period_s) noexcept {
  const double periods = std::ceil(width_s / period_s * (1.0 - 1e-12));
  return static_cast<int>(std::clamp(periods, 1.0, static_cast<double>(kMaxMeanPeriods)));
}

// Accelerations step from one limit to the other.
double needed_width_s(const MotionLimits& limits, double jerk_rad_s3) noexcept {
  return 2.0 * std::max(limits.acceleration_rad_s2, limits.deceleration_rad_s2) / jerk_rad_s3;
}

}  // namespace

MotionLimits JerkLimit::possible(const MotionLimits& limits, double jerk_rad_s3, double period_s) noexcept {
  const double largest_rad_s2 = 0.5 * jerk_rad_s3 * period_s * kMaxMeanPeriods;
  return {limits.velocity_rad_s, std::min(limits.acceleration_rad_s2, largest_rad_s2),
          std::min(limits.deceleration_rad_s2, largest_rad_s2)};
}

JerkLimit::JerkLimit(int periods, double period_s) noexcept
    : periods_(periods), period_s_(period_s), mean_(periods, period_s) {
  reset(0.0, 0.0);
}

JerkLimit::JerkLimit(const MotionLimits& limits, double jerk_rad_s3, double period_s) noexcept
    : JerkLimit(width_periods(needed_width_s(limits, jerk_rad_s3), period_s), period_s) {}

JerkLimit JerkLimit::spread_over(double width_s, double period_s) noexcept {
  return {width_periods(width_s, period_s), period_s};
}

double JerkLimit::reset(double position_rad, double velocity_rad_s) noexcept {
  const double planned_rad = position_rad + mean_.lag_s() * velocity_rad_s;
  mean_.reset(planned_rad, velocity_rad_s);
  now_ = {position_rad, velocity_rad_s, 0.0, 0.0};
  rest_periods_ = velocity_rad_s == 0.0 ? periods_ : 0;
  return planned_rad;
}

Reference JerkLimit::step(const Reference& planned) noexcept {
  const double h = period_s_;
  const MotionPoint end = mean_.step(
      {planned.position_rad + h * (planned.velocity_rad_s + 0.5 * h * planned.acceleration_rad_s2),
       planned.velocity_rad_s + h * planned.acceleration_rad_s2, planned.acceleration_rad_s2, 0.0});
  const Reference now{now_.position_rad, now_.velocity_rad_s, (end.velocity_rad_s - now_.velocity_rad_s) / h};
  now_ = end;
  const bool rests = planned.velocity_rad_s == 0.0 && planned.acceleration_rad_s2 == 0.0;
  rest_periods_ = rests ? std::min(rest_periods_ + 1, periods_) : 0;
  return now;
}

}  // namespace strainwave
