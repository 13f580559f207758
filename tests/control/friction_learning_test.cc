// SPDX-License-Identifier: BSD-3-Clause
// Scales of the temperature rules, learned from the feedback torque.
#include "control/friction/friction_learning.h"

#include <gtest/gtest.h>

#include <cmath>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 1e-3;
constexpr double kVelocity_rad_s = 0.5;

// Two rules, the cold one with twice the friction, at the weights 0.75 and 0.25.
FrictionLearning two_rules() {
  FuzzyFriction table;
  table.rule_count = 2;
  table.rules[0] = {0.0, 10.0, {6.0, 4.0, 2.0}};
  table.rules[1] = {20.0, 10.0, {3.0, 2.0, 1.0}};
  table.velocity.zero_width_rad_s = 0.2;
  TemperatureWeights weights;
  weights.count = 2;
  weights.weight[0] = 0.75;
  weights.weight[1] = 0.25;
  FrictionLearning learning;
  learning.load(table);
  learning.weigh(weights);
  return learning;
}

double friction_Nm(const FrictionLearning& learning) {
  return stribeck_friction_Nm(learning.friction(), {0.1, 2.0}, kVelocity_rad_s);
}

TEST(FrictionLearning, AddsTheFeedbackToTheFeedForwardAtTheRateOfItsHeader) {
  FrictionLearning learning = two_rules();
  const double before_Nm = friction_Nm(learning);
  const double feedback_Nm = 0.1;
  learning.learn(feedback_Nm, kVelocity_rad_s, kPeriod_s);
  const double friction_1_s = (friction_Nm(learning) - before_Nm) / feedback_Nm / kPeriod_s;
  const double load_1_s = learning.load_Nm() / feedback_Nm / kPeriod_s;
  EXPECT_GT(friction_1_s, load_1_s);
  EXPECT_GT(load_1_s, 0.0);
  EXPECT_LE(friction_1_s + load_1_s, 40.0 + 1e-6);  // the certified loop's bound
  // s_i' is proportional to w_i / F_i. The cold rule has three times the weight and twice the friction.
  EXPECT_NEAR(learning.learned().scale[0] / learning.learned().scale[1], 1.5, 1e-9);
}

TEST(FrictionLearning, TakesFeedbackAlongTheMotionForFrictionInBothDirections) {
  FrictionLearning forth = two_rules(), back = two_rules();
  forth.learn(0.1, kVelocity_rad_s, kPeriod_s);
  back.learn(-0.1, -kVelocity_rad_s, kPeriod_s);
  EXPECT_EQ(forth.learned().scale, back.learned().scale);
  EXPECT_EQ(forth.load_Nm(), -back.load_Nm());
}

TEST(FrictionLearning, KeepsItsScalesWithinTheirBounds) {
  FrictionLearning up = two_rules(), down = two_rules();
  for (int k = 0; k < 20000; ++k) {
    up.learn(100.0, kVelocity_rad_s, kPeriod_s);
    down.learn(-100.0, kVelocity_rad_s, kPeriod_s);
  }
  EXPECT_EQ(up.learned().scale[0], kMostScale);
  EXPECT_EQ(down.learned().scale[0], kLeastScale);
  EXPECT_NEAR(up.factor(), 1.0 + kMostScale, 1e-9);
  LearnedFriction wild;
  wild.scale.fill(1e6);
  up.set(wild);
  EXPECT_EQ(up.learned().scale[1], kMostScale);
}

TEST(FrictionLearning, LearnsNothingWhileItIsFrozen) {
  FrictionLearning learning = two_rules();
  learning.learn(0.1, kVelocity_rad_s, kPeriod_s);
  const LearnedFriction before = learning.learned();
  learning.freeze(true);
  learning.learn(0.1, kVelocity_rad_s, kPeriod_s);
  EXPECT_EQ(learning.learned(), before);
  learning.freeze(false);
  learning.learn(0.1, kVelocity_rad_s, kPeriod_s);
  EXPECT_NE(learning.learned(), before);
}

// With a wrong inertia, braking in the last tenth of a motion causes feedback torque that is not friction.
TEST(FrictionLearning, KeepsOfAMotionItsMeanAndNotItsEnd) {
  FrictionLearning learning = two_rules();
  const auto feed_back = [&](double feedback_Nm, int periods) {
    for (int k = 0; k < periods; ++k) learning.learn(feedback_Nm, kVelocity_rad_s, kPeriod_s);
  };
  feed_back(0.5, 100);
  const LearnedFriction cruise = learning.learned();
  feed_back(0.0, 800);
  feed_back(-2.0, 100);
  const LearnedFriction braked = learning.learned();
  learning.end_motion();
  const auto off = [&](const LearnedFriction& from) { return std::abs(from.scale[0] - cruise.scale[0]); };
  EXPECT_LT(off(learning.learned()), 0.25 * off(braked));
  EXPECT_LT(std::abs(learning.load_Nm() - cruise.load_Nm), 0.25 * std::abs(braked.load_Nm - cruise.load_Nm));
  const LearnedFriction kept = learning.learned();
  learning.learn_load(0.1, kPeriod_s);
  learning.end_motion();  // without a motion since the last call
  EXPECT_EQ(learning.learned().scale, kept.scale);
  EXPECT_GT(learning.load_Nm(), kept.load_Nm);
}

TEST(FrictionLearning, LeavesTheRuleOfAnotherTemperatureAsItIs) {
  FrictionLearning learning = two_rules();
  TemperatureWeights cold;
  cold.count = 2;
  cold.weight[0] = 1.0;
  learning.weigh(cold);
  learning.learn(0.1, kVelocity_rad_s, kPeriod_s);
  EXPECT_GT(learning.learned().scale[0], 0.0);
  EXPECT_EQ(learning.learned().scale[1], 0.0);
}

}  // namespace
}  // namespace strainwave
