#include "control/reference_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kMean_s = 0.02;
constexpr MotionLimits kLimits{5.0, 60.0, 60.0};
// Both limits of acceleration over the mean.
constexpr double kEasedStep_rad_s2 = 2.0 * 60.0 * kPeriod_s / kMean_s;

ReferencePlan eased() {
  ReferencePlan plan = ReferencePlan::eased(kPeriod_s, JerkLimit::spread_over(kMean_s, kPeriod_s));
  plan.set_limits(kLimits);
  return plan;
}

double largest_step_rad_s2(ReferencePlan& plan, Reference& last, int periods) {
  double largest = 0.0;
  for (int k = 0; k < periods; ++k) {
    const Reference now = plan.step();
    largest = std::max(largest, std::abs(now.acceleration_rad_s2 - last.acceleration_rad_s2));
    last = now;
  }
  return largest;
}

TEST(ReferencePlan, IsTheShapersMotionWherePlain) {
  ReferencePlan plan = ReferencePlan::plain(kPeriod_s);
  plan.set_limits(kLimits);
  ReferenceShaper shaper(kPeriod_s);
  shaper.set_limits(kLimits);
  plan.set_target(0.4);
  shaper.set_target(0.4);
  EXPECT_FALSE(plan.wants_easing());
  EXPECT_EQ(plan.lag_s(), 0.0);
  for (int k = 0; k < 400; ++k) {
    const Reference is = plan.step();
    const Reference expected = shaper.step();
    ASSERT_EQ(is.position_rad, expected.position_rad);
    ASSERT_EQ(is.acceleration_rad_s2, expected.acceleration_rad_s2);
    ASSERT_EQ(plan.rests(), shaper.at_target());
  }
  EXPECT_TRUE(plan.rests());
}

TEST(ReferencePlan, KeepsItsJerkWhateverIsOrderedWhereItIsLimited) {
  constexpr double kJerk_rad_s3 = 6000.0;
  ReferencePlan plan = ReferencePlan::limited(kPeriod_s, JerkLimit(kLimits, kJerk_rad_s3, kPeriod_s));
  plan.set_limits(kLimits);
  plan.begin(0.0, 0.0);
  std::mt19937 random(11);
  Reference last;
  for (int k = 0; k < 5000; ++k) {
    if (random() % 100 == 0) plan.set_target(std::uniform_real_distribution<double>(-1.0, 1.0)(random));
    if (random() % 500 == 0) plan.stop();
    const Reference now = plan.step();
    ASSERT_LE(std::abs(now.acceleration_rad_s2 - last.acceleration_rad_s2),
              kJerk_rad_s3 * kPeriod_s * (1.0 + 1e-6));
    last = now;
  }
}

TEST(ReferencePlan, RestsOnlyOnceTheMeanDoes) {
  ReferencePlan plan = eased();
  plan.set_target(0.1);
  plan.ease();
  Reference last;
  while (!plan.rests()) last = plan.step();
  EXPECT_EQ(plan.step().position_rad, 0.1);
  EXPECT_LT(last.acceleration_rad_s2, 0.0) << "the last period still brakes";
}

TEST(ReferencePlan, WantsEasingAtRestUntilItIsEased) {
  ReferencePlan plan = eased();
  EXPECT_TRUE(plan.wants_easing());
  EXPECT_EQ(plan.lag_s(), 0.0);
  plan.ease();
  EXPECT_FALSE(plan.wants_easing());
  EXPECT_NEAR(plan.lag_s(), 0.5 * kMean_s, 1e-12);
  plan.end_easing();
  EXPECT_TRUE(plan.wants_easing());
  plan.set_target(1.0);
  plan.step();
  plan.step();
  EXPECT_FALSE(plan.wants_easing()) << "it moves";
  ReferencePlan limited = ReferencePlan::limited(kPeriod_s, JerkLimit(kLimits, 6000.0, kPeriod_s));
  EXPECT_FALSE(limited.wants_easing());
}

TEST(ReferencePlan, EasesEveryMotionUntilItEndsIt) {
  ReferencePlan plan = eased();
  plan.ease();
  Reference last;
  plan.set_target(0.5);
  EXPECT_LE(largest_step_rad_s2(plan, last, 80), kEasedStep_rad_s2 * (1.0 + 1e-6));
  plan.stop();
  EXPECT_LE(largest_step_rad_s2(plan, last, 300), kEasedStep_rad_s2 * (1.0 + 1e-6));
  plan.end_easing();
  plan.set_target(0.0);
  EXPECT_GT(largest_step_rad_s2(plan, last, 80), 50.0);
}

// As docs/theory.md tells of a hold.
TEST(ReferencePlan, StopsFartherByItsLagTimesTheSpeed) {
  ReferencePlan plan = eased();
  plan.ease();
  plan.set_target(10.0);
  Reference last;
  for (int k = 0; k < 300; ++k) last = plan.step();
  ASSERT_NEAR(last.velocity_rad_s, kLimits.velocity_rad_s, 1e-9);
  const Reference at = plan.step();
  plan.stop();
  while (!plan.rests()) last = plan.step();
  const double speed = at.velocity_rad_s;
  // The sample of the stop itself is one more period.
  EXPECT_NEAR(last.position_rad - at.position_rad - kPeriod_s * speed,
              speed * 0.5 * kMean_s + 0.5 * speed * speed / kLimits.deceleration_rad_s2, 1e-5);
}

TEST(ReferencePlan, GoesOnWhereTheMeanIsWhereEasingEnds) {
  ReferencePlan plan = eased();
  plan.ease();
  plan.set_target(0.5);
  Reference last;
  for (int k = 0; k < 60; ++k) last = plan.step();
  ASSERT_GT(plan.position_rad(), last.position_rad + 0.01) << "the shaper is ahead";
  plan.end_easing();
  const Reference now = plan.step();
  EXPECT_NEAR(
      now.position_rad,
      last.position_rad + kPeriod_s * (last.velocity_rad_s + 0.5 * kPeriod_s * last.acceleration_rad_s2),
      1e-12);
  EXPECT_NEAR(now.velocity_rad_s, last.velocity_rad_s + kPeriod_s * last.acceleration_rad_s2, 1e-12);
}

TEST(ReferencePlan, BeginsWithoutEasingAndGoesOnWithIt) {
  ReferencePlan plan = eased();
  plan.ease();
  plan.set_target(0.5);
  plan.go_on_from(0.2, 1.0);
  Reference now = plan.step();
  EXPECT_NEAR(now.position_rad, 0.2, 1e-12);
  EXPECT_NEAR(now.velocity_rad_s, 1.0, 1e-12);
  EXPECT_GT(plan.lag_s(), 0.0);
  EXPECT_EQ(plan.target_rad(), 0.5);
  plan.begin(0.3, -1.0);
  EXPECT_EQ(plan.lag_s(), 0.0);
  now = plan.step();
  EXPECT_EQ(now.position_rad, 0.3);
  EXPECT_EQ(now.velocity_rad_s, -1.0);
  while (!plan.rests()) now = plan.step();
  EXPECT_NEAR(now.position_rad, 0.3 - 0.5 / kLimits.deceleration_rad_s2, 1e-3) << "where it can stop";
}

TEST(ReferencePlan, TakesAMotionUpEasedAndIsPlainAgainOnceAStreamOrAStartDoes) {
  for (const bool stream : {true, false}) {
    ReferencePlan plan =
        ReferencePlan::plain_until_eased(kPeriod_s, JerkLimit::spread_over(kMean_s, kPeriod_s));
    plan.set_limits(kLimits);
    plan.set_target(0.5);
    Reference last;
    EXPECT_FALSE(plan.wants_easing());
    EXPECT_GT(largest_step_rad_s2(plan, last, 40), 50.0) << "plain";
    plan.ease_from(last.position_rad, last.velocity_rad_s);
    Reference now = plan.step();
    EXPECT_NEAR(now.position_rad, last.position_rad, 1e-12);
    EXPECT_NEAR(now.velocity_rad_s, last.velocity_rad_s, 1e-12);
    EXPECT_EQ(plan.target_rad(), 0.5);
    EXPECT_LE(largest_step_rad_s2(plan, now, 80), kEasedStep_rad_s2 * (1.0 + 1e-6));
    if (stream)
      plan.end_easing();
    else
      plan.begin(0.0, 0.0);
    EXPECT_EQ(plan.lag_s(), 0.0);
    EXPECT_FALSE(plan.wants_easing());
  }
}

TEST(ReferencePlan, FollowsAStream) {
  ReferencePlan plan = eased();
  StreamTarget stream(kPeriod_s, 0.05);
  stream.begin(0.0, 0.0, 0.0);
  double worst_rad = 0.0;
  for (int k = 0; k < 1000; ++k) {
    const double at_s = kPeriod_s * k;
    if (k % 10 == 0) {
      StreamSample sample;
      sample.position_rad = 0.2 * (1.0 - std::cos(3.0 * (at_s + 0.02)));
      sample.velocity_rad_s = 0.6 * std::sin(3.0 * (at_s + 0.02));
      sample.derivatives = 1;
      sample.in_periods = 20;
      stream.take(sample, {kLimits.velocity_rad_s, kLimits.acceleration_rad_s2});
    }
    const Reference now = plan.follow(stream.step(), {});
    if (k > 300)
      worst_rad = std::max(worst_rad, std::abs(now.position_rad - 0.2 * (1.0 - std::cos(3.0 * at_s))));
  }
  EXPECT_LT(worst_rad, 1e-5);
}

// As it is when it begins, wherever it was before.
TEST(ReferencePlan, EasesAPathWhereMovesAreEasedAndTellsHowLateThatMakesIt) {
  ReferencePlan path = eased();
  EXPECT_EQ(path.lag_s(), 0.0) << "not yet";
  EXPECT_GT(path.path_lag_s(), 0.0);
  path.begin_path();
  EXPECT_EQ(path.lag_s(), path.path_lag_s());
  path.begin_path();
  EXPECT_EQ(path.lag_s(), path.path_lag_s()) << "it was before";
  ReferencePlan followed =
      ReferencePlan::plain_until_eased(kPeriod_s, JerkLimit::spread_over(kMean_s, kPeriod_s));
  followed.set_limits(kLimits);
  followed.ease_from(0.0, 0.0);
  EXPECT_EQ(followed.path_lag_s(), 0.0);
  followed.begin_path();
  EXPECT_EQ(followed.lag_s(), 0.0) << "its spring is told";
  ReferencePlan limited = ReferencePlan::limited(kPeriod_s, JerkLimit(kLimits, 6000.0, kPeriod_s));
  EXPECT_EQ(limited.path_lag_s(), limited.lag_s());
  EXPECT_GT(limited.path_lag_s(), 0.0);
  EXPECT_EQ(ReferencePlan::plain(kPeriod_s).path_lag_s(), 0.0);
}

// Where it goes on from on the way it stays eased, and goes on without a step.
TEST(ReferencePlan, GoesOnWithAPathThatBeginsAnewOnTheWay) {
  ReferencePlan plan = eased();
  plan.begin_path();
  plan.set_target(0.5);
  Reference last;
  (void)largest_step_rad_s2(plan, last, 60);
  plan.begin_path();
  EXPECT_LT(largest_step_rad_s2(plan, last, 400), kEasedStep_rad_s2 + 1e-6);
  EXPECT_TRUE(plan.rests());
}

}  // namespace
}  // namespace strainwave
