#include "control/jerk_limit.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// Accelerations step from one limit to the other.
int width_periods(const MotionLimits& limits, double jerk_rad_s3, double period_s) noexcept {
  const double largest_rad_s2 = std::max(limits.acceleration_rad_s2, limits.deceleration_rad_s2);
  // Rounding makes no period of its own.
  const double periods = std::ceil(2.0 * largest_rad_s2 / (jerk_rad_s3 * period_s) * (1.0 - 1e-12));
  return static_cast<int>(std::clamp(periods, 1.0, static_cast<double>(kMaxMeanPeriods)));
}

}  // namespace

MotionLimits JerkLimit::possible(const MotionLimits& limits, double jerk_rad_s3, double period_s) noexcept {
  const double largest_rad_s2 = 0.5 * jerk_rad_s3 * period_s * kMaxMeanPeriods;
  return {limits.velocity_rad_s, std::min(limits.acceleration_rad_s2, largest_rad_s2),
          std::min(limits.deceleration_rad_s2, largest_rad_s2)};
}

JerkLimit::JerkLimit(const MotionLimits& limits, double jerk_rad_s3, double period_s) noexcept
    : periods_(width_periods(limits, jerk_rad_s3, period_s)), period_s_(period_s), mean_(periods_, period_s) {
  reset(0.0, 0.0);
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
