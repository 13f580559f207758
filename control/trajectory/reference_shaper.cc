// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/reference_shaper.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/printable.h"
#include "base/units.h"

namespace strainwave {

namespace {
// Rounding that thousands of samples may accumulate; far below any encoder's count.
constexpr double kPositionRounding_rad = 1e-12;
// Least share of a limit for approaching or braking that an accelerating target leaves.
constexpr double kLeastLeft = 0.2;
// A moving target is far away beyond the distance that the acceleration covers from rest in this time.
constexpr double kFar_s = 0.1;
}  // namespace

void ReferenceShaper::reset(double position_rad, double velocity_rad_s) noexcept {
  position_rad_ = position_rad;
  velocity_rad_s_ = velocity_rad_s;
  target_rad_ = position_rad;
  stopping_ = velocity_rad_s != 0.0;
}

void ReferenceShaper::set_target(double position_rad) noexcept {
  target_rad_ = position_rad;
  stopping_ = false;
}

// Reduces the speed by at most one sample's deceleration.
double ReferenceShaper::brake_to_rest(double velocity_rad_s) const noexcept {
  const double speed = std::max(0.0, std::abs(velocity_rad_s) - period_s_ * limits_.deceleration_rad_s2);
  return std::copysign(speed, velocity_rad_s);
}

// Inverse of G(v') = S(v') + h v' / 2, which is piecewise linear with G(n D h) = D h^2 n (n + 1) / 2.
double ReferenceShaper::largest_stoppable_velocity(double distance_rad,
                                                   double deceleration_rad_s2) const noexcept {
  if (distance_rad <= 0.0) return 0.0;
  if (!std::isfinite(distance_rad)) return distance_rad;
  const double speed_step = period_s_ * deceleration_rad_s2;
  const double scaled = distance_rad / (period_s_ * speed_step);
  const double whole = std::floor(0.5 * (std::sqrt(1.0 + 8.0 * scaled) - 1.0));
  const double beyond = scaled - 0.5 * whole * (whole + 1.0);
  return speed_step * (whole + beyond / (whole + 1.0));
}

// Velocity from which the joint can stop on its target. It may exceed the limits.
double ReferenceShaper::wanted_velocity_rad_s() const noexcept {
  const double to_target_rad = target_rad_ - position_rad_;
  const double direction = to_target_rad != 0.0 ? sign(to_target_rad) : -sign(velocity_rad_s_);
  const double left_rad = std::abs(to_target_rad) - 0.5 * period_s_ * direction * velocity_rad_s_;
  return direction * largest_stoppable_velocity(left_rad, limits_.deceleration_rad_s2);
}

// Limits the wanted velocity. The acceleration limits take precedence over range and speed.
double ReferenceShaper::possible_velocity_rad_s(double wanted_rad_s,
                                                const PositionRange& range) const noexcept {
  const double decelerating = period_s_ * limits_.deceleration_rad_s2;
  const double accelerating = period_s_ * limits_.acceleration_rad_s2;
  const double middle_rad = position_rad_ + 0.5 * period_s_ * velocity_rad_s_;
  const double up = std::min(limits_.velocity_rad_s, largest_stoppable_velocity(range.max_rad - middle_rad,
                                                                                limits_.deceleration_rad_s2));
  const double down =
      std::min(limits_.velocity_rad_s,
               largest_stoppable_velocity(middle_rad - range.min_rad, limits_.deceleration_rad_s2));
  const double inside = std::clamp(wanted_rad_s, -down, up);
  // A sample that turns round has one acceleration, so both limits hold in it.
  const double turning = std::min(accelerating, decelerating);
  const bool forward = velocity_rad_s_ > 0.0;
  const bool backward = velocity_rad_s_ < 0.0;
  const double slowest =
      velocity_rad_s_ - (forward ? std::max(turning, std::min(decelerating, velocity_rad_s_)) : accelerating);
  const double fastest =
      velocity_rad_s_ +
      (backward ? std::max(turning, std::min(decelerating, -velocity_rad_s_)) : accelerating);
  return std::clamp(inside, slowest, fastest);
}

Reference ReferenceShaper::advance_to(double velocity_rad_s) noexcept {
  const Reference reference{position_rad_, velocity_rad_s_, (velocity_rad_s - velocity_rad_s_) / period_s_};
  position_rad_ += 0.5 * period_s_ * (velocity_rad_s_ + velocity_rad_s);
  velocity_rad_s_ = velocity_rad_s;
  return reference;
}

// Relative velocity towards the target. The acceleration of a far target is ignored: a braking target would brake a joint that has yet to
// reach it. possible_velocity_rad_s() applies the limits.
double ReferenceShaper::nearing_rad_s(const MovingTarget& target) const noexcept {
  // Distance to the point from which a target, at the mean of its two velocities, would reach its next position.
  const double to_target_rad = target.next_position_rad - position_rad_ -
                               0.5 * period_s_ * (target.velocity_rad_s + target.next_velocity_rad_s);
  const double relative_rad_s = velocity_rad_s_ - target.velocity_rad_s;
  const double direction = to_target_rad != 0.0 ? sign(to_target_rad) : -sign(relative_rad_s);
  const double velocity = direction * relative_rad_s;
  const double flees_rad_s2 = direction * (target.next_velocity_rad_s - target.velocity_rad_s) / period_s_;
  const auto left = [](double limit, double taken) {
    return std::max(kLeastLeft * limit, limit - std::max(0.0, taken));
  };
  const double braking_rad_s2 = left(limits_.deceleration_rad_s2, -flees_rad_s2);
  const double stoppable =
      largest_stoppable_velocity(std::abs(to_target_rad) - 0.5 * period_s_ * velocity, braking_rad_s2);
  if (std::abs(to_target_rad) > 0.5 * limits_.acceleration_rad_s2 * kFar_s * kFar_s)
    return direction * stoppable;
  const double speed_up = period_s_ * left(limits_.acceleration_rad_s2, flees_rad_s2);
  return direction *
         std::max(std::min(velocity + speed_up, stoppable), velocity - period_s_ * braking_rad_s2);
}

Reference ReferenceShaper::follow(const MovingTarget& target, const PositionRange& range) noexcept {
  set_target(target.next_position_rad);
  if (target.rests()) return step();
  return advance_to(possible_velocity_rad_s(target.next_velocity_rad_s + nearing_rad_s(target), range));
}

Reference ReferenceShaper::step() noexcept {
  double velocity =
      stopping_ ? brake_to_rest(velocity_rad_s_) : possible_velocity_rad_s(wanted_velocity_rad_s(), {});
  // A speed this far below one sample's deceleration is the rounding of a motion that has ended.
  if (std::abs(velocity) <= kAtBound * period_s_ * limits_.deceleration_rad_s2) velocity = 0.0;
  const Reference reference = advance_to(velocity);
  if (velocity != 0.0) return reference;
  if (stopping_) target_rad_ = position_rad_;
  const double rounding_rad =
      kPositionRounding_rad + 4.0 * std::numeric_limits<double>::epsilon() * std::abs(target_rad_);
  if (std::abs(position_rad_ - target_rad_) <= rounding_rad) position_rad_ = target_rad_;
  return reference;
}

}  // namespace strainwave
