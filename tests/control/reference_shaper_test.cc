// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/reference_shaper.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr double kRelativeRounding = 1e-6;
constexpr double kPositionRounding_rad = 1e-12;

class Cases {
 public:
  explicit Cases(unsigned seed) : engine_(seed) {}
  double log_uniform(double low, double high) {
    return std::exp(std::uniform_real_distribution<double>(std::log(low), std::log(high))(engine_));
  }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(engine_);
  }
  MotionLimits limits() {
    return {log_uniform(0.05, 20.0), log_uniform(0.5, 1000.0), log_uniform(0.5, 1000.0)};
  }
  double target() { return std::copysign(log_uniform(1e-6, 3.0), uniform(-1.0, 1.0)); }

 private:
  std::mt19937_64 engine_;
};

// Continuous-time optimum from rest: a trapezoidal or triangular speed profile.
double shortest_time_from_rest_s(double distance_rad, const MotionLimits& limits) {
  const double a = limits.acceleration_rad_s2;
  const double d = limits.deceleration_rad_s2;
  const double peak = std::min(limits.velocity_rad_s, std::sqrt(2.0 * distance_rad * a * d / (a + d)));
  const double cruise_rad = distance_rad - 0.5 * peak * peak * (1.0 / a + 1.0 / d);
  return peak / a + peak / d + std::max(0.0, cruise_rad) / peak;
}

// The same from any velocity. A motion away from the target, or too fast to stop before it, first brakes to rest.
double shortest_time_s(double distance_rad, double velocity, const MotionLimits& limits) {
  const double stop_rad = 0.5 * velocity * std::abs(velocity) / limits.deceleration_rad_s2;
  if (velocity < 0.0 || stop_rad > distance_rad)
    return std::abs(velocity) / limits.deceleration_rad_s2 +
           shortest_time_from_rest_s(std::abs(distance_rad - stop_rad), limits);
  // Prepend the acceleration from rest that leads here: the optimum from there passes through this state.
  const double run_up_rad = 0.5 * velocity * velocity / limits.acceleration_rad_s2;
  return shortest_time_from_rest_s(distance_rad + run_up_rad, limits) - velocity / limits.acceleration_rad_s2;
}

void expect_within_limits(const Reference& from, const Reference& to, const MotionLimits& limits) {
  const bool speeding_up = std::abs(to.velocity_rad_s) > std::abs(from.velocity_rad_s);
  const double allowed = speeding_up ? limits.acceleration_rad_s2 : limits.deceleration_rad_s2;
  ASSERT_LE(std::abs(from.acceleration_rad_s2), allowed * (1.0 + kRelativeRounding));
  ASSERT_LE(std::abs(to.velocity_rad_s), limits.velocity_rad_s * (1.0 + kRelativeRounding));
}

void expect_consistent(const Reference& from, const Reference& to) {
  ASSERT_NEAR(to.velocity_rad_s, from.velocity_rad_s + kPeriod_s * from.acceleration_rad_s2, 1e-12);
  ASSERT_NEAR(to.position_rad,
              from.position_rad + 0.5 * kPeriod_s * (from.velocity_rad_s + to.velocity_rad_s), 1e-12);
}

TEST(ReferenceShaper, ReturnsToWhereItBeganAtRestHoweverOftenItBeginsAnew) {
  ReferenceShaper shaper(0.001);
  shaper.set_limits({5.0, 60.0, 60.0});
  shaper.reset(0.25, 0.0);
  (void)shaper.step();
  for (int time = 0; time < 10; ++time) {
    shaper.restart(shaper.position_rad() + 1e-4, 0.0);
    (void)shaper.step();
  }
  EXPECT_EQ(shaper.target_rad(), 0.25);
}

TEST(ReferenceShaper, ReachesTheTargetExactlyAndStaysWithoutOvershootNearTheShortestTime) {
  Cases cases(1);
  for (int run = 0; run < 2000; ++run) {
    const MotionLimits limits = cases.limits();
    const double target = cases.target();
    ReferenceShaper shaper(kPeriod_s);
    shaper.set_limits(limits);
    shaper.set_target(target);
    const double shortest_s = shortest_time_from_rest_s(std::abs(target), limits);
    const int allowed = static_cast<int>(std::ceil(shortest_s / kPeriod_s)) + 2;
    Reference from = shaper.step();
    for (int k = 0; k < allowed; ++k) {
      const Reference to = shaper.step();
      expect_within_limits(from, to, limits);
      expect_consistent(from, to);
      ASSERT_LE(to.position_rad * std::copysign(1.0, target), std::abs(target) + kPositionRounding_rad);
      from = to;
    }
    ASSERT_TRUE(shaper.at_target()) << "target " << target << " run " << run;
    ASSERT_EQ(from.position_rad, target);
    ASSERT_EQ(from.velocity_rad_s, 0.0);
    for (int k = 0; k < 3; ++k) {
      const Reference rest = shaper.step();
      ASSERT_EQ(rest.position_rad, target);
      ASSERT_EQ(rest.velocity_rad_s, 0.0);
      ASSERT_EQ(rest.acceleration_rad_s2, 0.0);
    }
  }
}

TEST(ReferenceShaper, KeepsItsLimitsAndArrivesWhenTheTargetChangesOnTheWay) {
  Cases cases(2);
  for (int run = 0; run < 2000; ++run) {
    const MotionLimits limits = cases.limits();
    ReferenceShaper shaper(kPeriod_s);
    shaper.set_limits(limits);
    shaper.set_target(cases.target());
    Reference from = shaper.step();
    const int before = static_cast<int>(cases.log_uniform(1.0, 500.0));
    for (int k = 0; k < before; ++k) {
      const Reference to = shaper.step();
      expect_within_limits(from, to, limits);
      from = to;
    }
    const double target = cases.target();
    shaper.set_target(target);
    // The current period still has the old target.
    from = {
        from.position_rad + kPeriod_s * (from.velocity_rad_s + 0.5 * kPeriod_s * from.acceleration_rad_s2),
        from.velocity_rad_s + kPeriod_s * from.acceleration_rad_s2, 0.0};
    const double direction = std::copysign(1.0, target - from.position_rad);
    const double shortest_s =
        shortest_time_s(std::abs(target - from.position_rad), direction * from.velocity_rad_s, limits);
    const int allowed = static_cast<int>(std::ceil(shortest_s / kPeriod_s)) + 4;
    Reference previous = shaper.step();
    for (int k = 0; k < allowed; ++k) {
      const Reference to = shaper.step();
      expect_within_limits(previous, to, limits);
      expect_consistent(previous, to);
      previous = to;
    }
    ASSERT_TRUE(shaper.at_target()) << "run " << run << " missing " << target - previous.position_rad
                                    << " after " << allowed << " V " << limits.velocity_rad_s;
    ASSERT_EQ(previous.position_rad, target);
  }
}

TEST(ReferenceShaper, StopsWithItsDecelerationAndStaysThere) {
  ReferenceShaper shaper(kPeriod_s);
  shaper.set_limits({2.0, 10.0, 40.0});
  shaper.set_target(5.0);
  for (int k = 0; k < 150; ++k) shaper.step();
  const Reference moving = shaper.step();
  ASSERT_GT(moving.velocity_rad_s, 1.0);
  shaper.stop();
  double rest_rad = 0.0;
  for (int k = 0; k < 60; ++k) rest_rad = shaper.step().position_rad;
  EXPECT_TRUE(shaper.at_target());
  const double braking_rad = 0.5 * moving.velocity_rad_s * moving.velocity_rad_s / 40.0;
  EXPECT_NEAR(rest_rad, moving.position_rad + braking_rad, 2.0 * moving.velocity_rad_s * kPeriod_s);
  EXPECT_EQ(shaper.step().position_rad, rest_rad);
}

TEST(ReferenceShaper, SlowsDownWithinTheNewLimitsWhenTheyShrinkOnTheWay) {
  Cases cases(3);
  for (int run = 0; run < 500; ++run) {
    const MotionLimits first = cases.limits();
    const MotionLimits second = cases.limits();
    const double target = cases.target();
    ReferenceShaper shaper(kPeriod_s);
    shaper.set_limits(first);
    shaper.set_target(target);
    for (int k = 0; k < 50; ++k) shaper.step();
    shaper.set_limits(second);
    shaper.step();
    Reference from = shaper.step();
    for (int k = 0; k < 200000 && !shaper.at_target(); ++k) {
      const Reference to = shaper.step();
      const bool slows_down = std::abs(to.velocity_rad_s) <= std::abs(from.velocity_rad_s);
      ASSERT_LE(
          std::abs(from.acceleration_rad_s2),
          (slows_down ? second.deceleration_rad_s2 : second.acceleration_rad_s2) * (1.0 + kRelativeRounding));
      if (!slows_down) {
        ASSERT_LE(std::abs(to.velocity_rad_s), second.velocity_rad_s * (1.0 + kRelativeRounding));
      }
      from = to;
    }
    ASSERT_TRUE(shaper.at_target()) << "run " << run;
  }
}

// A shaper that copied the target's acceleration would brake with the target and never start.
TEST(ReferenceShaper, GoesAfterAFarTargetThatBrakesWithAllOfItsAcceleration) {
  constexpr double h = 1e-3;
  constexpr double kLimit_rad_s2 = 30.0;
  ReferenceShaper shaper(h);
  shaper.set_limits({4.0, kLimit_rad_s2, kLimit_rad_s2});
  shaper.reset(0.0, 0.0);
  MovingTarget target{0.7, 2.0, 0.0, 0.0};
  for (int k = 0; k < 60; ++k) {
    target.next_velocity_rad_s = target.velocity_rad_s - h * kLimit_rad_s2;
    target.next_position_rad =
        target.position_rad + 0.5 * h * (target.velocity_rad_s + target.next_velocity_rad_s);
    shaper.follow(target, {});
    target.position_rad = target.next_position_rad;
    target.velocity_rad_s = target.next_velocity_rad_s;
  }
  EXPECT_NEAR(shaper.velocity_rad_s(), 60 * h * kLimit_rad_s2, 1e-9);
}

}  // namespace
}  // namespace strainwave
