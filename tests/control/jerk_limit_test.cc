#include "control/jerk_limit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr MotionLimits kLimits{8.0, 60.0, 80.0};

/// Plans towards targets that change at any moment, and keeps the jerk of what it plans.
class Smoothed {
 public:
  explicit Smoothed(double jerk_rad_s3)
      : limits_(JerkLimit::possible(kLimits, jerk_rad_s3, kPeriod_s)),
        limit_(limits_, jerk_rad_s3, kPeriod_s) {
    shaper_.set_limits(limits_);
  }
  Reference step() { return limit_.step(shaper_.step()); }
  ReferenceShaper& shaper() { return shaper_; }
  JerkLimit& limit() { return limit_; }
  const MotionLimits& limits() const { return limits_; }

 private:
  MotionLimits limits_;
  JerkLimit limit_;
  ReferenceShaper shaper_{kPeriod_s};
};

TEST(JerkLimit, KeepsJerkSpeedAccelerationAndRangeWhateverIsPlanned) {
  for (const double jerk_rad_s3 : {300.0, 2000.0, 10000.0, 150000.0}) {
    std::mt19937 random(7);
    Smoothed smoothed(jerk_rad_s3);
    const double fastest =
        std::max(smoothed.limits().acceleration_rad_s2, smoothed.limits().deceleration_rad_s2);
    Reference last = smoothed.step();
    double largest = 0.0;
    for (int k = 0; k < 20000; ++k) {
      if (random() % 100 == 0)
        smoothed.shaper().set_target(std::uniform_real_distribution<double>(-1.0, 1.0)(random));
      if (random() % 1000 == 0) smoothed.shaper().stop();
      const Reference now = smoothed.step();
      const double jerk = std::abs(now.acceleration_rad_s2 - last.acceleration_rad_s2) / kPeriod_s;
      largest = std::max(largest, jerk);
      ASSERT_LE(jerk, jerk_rad_s3 * (1.0 + 1e-6)) << k;
      ASSERT_LE(std::abs(now.velocity_rad_s), kLimits.velocity_rad_s * (1.0 + 1e-9)) << k;
      ASSERT_LE(std::abs(now.acceleration_rad_s2), fastest * (1.0 + 1e-9)) << k;
      ASSERT_LE(std::abs(now.position_rad), 1.2) << k;
      ASSERT_NEAR(now.position_rad, last.position_rad + kPeriod_s * last.velocity_rad_s, 1e-4) << "no jump";
      last = now;
    }
    EXPECT_GT(largest, 0.3 * jerk_rad_s3) << "it is used";
  }
}

TEST(JerkLimit, EndsExactlyOnTheTargetAndSaysSoOnlyThen) {
  Smoothed smoothed(2000.0);
  smoothed.shaper().set_target(0.7);
  Reference reference;
  int early = 0;
  for (int k = 0; k < 3000; ++k) {
    reference = smoothed.step();
    const bool there = smoothed.shaper().at_target() && smoothed.limit().rests();
    if (there && (reference.velocity_rad_s != 0.0 || reference.acceleration_rad_s2 != 0.0)) ++early;
  }
  EXPECT_LE(early, 1) << "the period in which it comes to rest";
  EXPECT_EQ(reference.position_rad, 0.7);
  EXPECT_EQ(reference.velocity_rad_s, 0.0);
  EXPECT_TRUE(smoothed.limit().rests());
}

TEST(JerkLimit, GoesOnFromWhereTheJointIsWithoutAJump) {
  Smoothed smoothed(2000.0);
  smoothed.shaper().reset(smoothed.limit().reset(0.3, 2.0), 2.0);
  const Reference first = smoothed.step();
  EXPECT_DOUBLE_EQ(first.position_rad, 0.3);
  EXPECT_DOUBLE_EQ(first.velocity_rad_s, 2.0);
  EXPECT_LE(std::abs(first.acceleration_rad_s2), 2000.0 * kPeriod_s * (1.0 + 1e-6));
}

TEST(JerkLimit, IsLaterThanThePlanByTheLagThatItNames) {
  JerkLimit limit({8.0, 20.0, 20.0}, 2000.0, kPeriod_s);
  EXPECT_NEAR(limit.lag_s(), 0.01, 1e-12);
  Reference planned{0.0, 1.0, 0.0};
  Reference reference;
  for (int k = 0; k < 100; ++k) {
    planned.position_rad = k * kPeriod_s;
    reference = limit.step(planned);
  }
  EXPECT_NEAR(planned.position_rad - reference.position_rad, limit.lag_s() * 1.0, 1e-12);
}

TEST(JerkLimit, SpreadsAStepOfTheAccelerationOverTheTimeItIsTold) {
  JerkLimit limit = JerkLimit::spread_over(0.02, kPeriod_s);
  EXPECT_NEAR(limit.lag_s(), 0.01, 1e-12);
  limit.reset(0.0, 0.0);
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  for (int k = 0; k < 40; ++k) {
    const Reference eased = limit.step({position_rad, velocity_rad_s, 50.0});
    position_rad += kPeriod_s * (velocity_rad_s + 0.5 * kPeriod_s * 50.0);
    velocity_rad_s += 50.0 * kPeriod_s;
    EXPECT_NEAR(eased.acceleration_rad_s2, 50.0 * std::min(1.0, (k + 0.5) * kPeriod_s / 0.02), 1e-9) << k;
    EXPECT_NEAR(limit.velocity_rad_s(), eased.velocity_rad_s + kPeriod_s * eased.acceleration_rad_s2, 1e-12);
  }
}

}  // namespace
}  // namespace strainwave
