// SPDX-License-Identifier: BSD-3-Clause
// Learned friction of a joint: it is in the state, obeys orders, and causes a notice if it is far from the table's.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

LearnedFriction learned_everywhere(double scale) {
  LearnedFriction learned;
  learned.scale.fill(scale);
  return learned;
}

class JointLoopLearning : public ::testing::Test {
 protected:
  /// As after a restart of the daemon, 5 s after the joint last learned.
  void hold_with(double scale) {
    bench_.joint(0).joint().law.restore(
        learned_everywhere(scale), {.learned_C = 18.0, .learned_ns = bench_.time().now_ns - 5'000'000'000});
    bench_.bring_to_hold(0);
  }
  Reason load(std::int32_t slot, std::int64_t friction_rules_id) {
    bench_.joint(0).table_slot(static_cast<std::size_t>(slot)) = {demo_table(), slot, friction_rules_id};
    return bench_.order(0, Order{.kind = OrderKind::kUseTable, .table_slot = slot});
  }
  const state_v1& state() { return bench_.state(0); }
  JointBench bench_{{demo_joint()}};
};

TEST_F(JointLoopLearning, ShowsThatNothingWasLearnedYet) {
  bench_.bring_to_hold(0);
  EXPECT_EQ(state().friction_factor, 1.0);
  EXPECT_TRUE(std::isnan(state().friction_learned_C));
  EXPECT_EQ(state().friction_age_s, -1.0);
  EXPECT_EQ(state().friction_frozen, 0);
  EXPECT_FALSE(bench_.has_notice(0, Notice::kFrictionDiffers));
}

TEST_F(JointLoopLearning, ShowsWhatWasLearnedBesideTheRulesOfTheTable) {
  hold_with(0.25);
  ASSERT_GT(state().rule_count, 1);
  EXPECT_DOUBLE_EQ(state().friction_factor, 1.25);
  EXPECT_EQ(state().friction_learned_C, 18.0);
  EXPECT_GE(state().friction_age_s, 5.0);
  for (std::size_t i = 0; i < static_cast<std::size_t>(state().rule_count); ++i) {
    EXPECT_EQ(state().friction_scales[i], 0.25);
    EXPECT_EQ(state().friction_rule_C[i], demo_table().friction.rules[i].center_C);
  }
}

TEST_F(JointLoopLearning, SaysWhereFrictionDiffersFromTheTable) {
  for (const auto& [scale, differs] : {std::pair{-0.5, true}, {-0.3, false}, {0.4, false}, {1.0, true}}) {
    JointBench bench({demo_joint()});
    bench.joint(0).joint().law.restore(learned_everywhere(scale), {});
    bench.bring_to_hold(0);
    EXPECT_EQ(bench.has_notice(0, Notice::kFrictionDiffers), differs) << scale;
  }
}

TEST_F(JointLoopLearning, IsForgottenByAResetWithoutATorqueStepAndStaysFrozen) {
  hold_with(1.0);
  ASSERT_EQ(bench_.order(0, OrderKind::kFreezeLearning), Reason::kAccepted);
  const double before_Nm = state().torque_commanded_Nm;
  EXPECT_EQ(bench_.order(0, OrderKind::kResetLearning), Reason::kAccepted);
  EXPECT_NEAR(state().torque_commanded_Nm, before_Nm, 0.01 * demo_table().torque_limit_Nm);
  EXPECT_EQ(state().friction_factor, 1.0);
  EXPECT_EQ(state().friction_age_s, -1.0);
  EXPECT_EQ(state().friction_frozen, 1);
  EXPECT_TRUE(std::isnan(state().friction_learned_C));
  EXPECT_FALSE(bench_.has_notice(0, Notice::kFrictionDiffers));
}

TEST_F(JointLoopLearning, IsNotResetWhileTheJointMovesButWhileItIsOff) {
  bench_.joint(0).joint().law.restore(learned_everywhere(0.25), {});
  EXPECT_EQ(bench_.order(0, OrderKind::kResetLearning), Reason::kAccepted);
  hold_with(0.25);
  ASSERT_EQ(bench_.move(0, 0.5), Reason::kAccepted);
  EXPECT_EQ(bench_.order(0, OrderKind::kResetLearning), Reason::kMoving);
  EXPECT_EQ(state().friction_scales[0], 0.25);
}

TEST_F(JointLoopLearning, IsFrozenAndResumedByOrdersWhateverTheJointDoes) {
  hold_with(0.25);
  ASSERT_EQ(bench_.move(0, 0.5), Reason::kAccepted);
  EXPECT_EQ(bench_.order(0, OrderKind::kFreezeLearning), Reason::kAccepted);
  EXPECT_EQ(state().friction_frozen, 1);
  EXPECT_EQ(state().friction_scales[0], 0.25);
  EXPECT_EQ(bench_.order(0, OrderKind::kResumeLearning), Reason::kAccepted);
  EXPECT_EQ(state().friction_frozen, 0);
}

TEST_F(JointLoopLearning, BelongsToTheFrictionRulesOfTheTable) {
  hold_with(0.25);
  ASSERT_EQ(load(1, 0), Reason::kAccepted);  // the same rules as the first table
  EXPECT_EQ(state().friction_scales[0], 0.25);
  ASSERT_EQ(load(2, 7), Reason::kAccepted);
  EXPECT_EQ(state().friction_scales[0], 0.0);
  EXPECT_EQ(state().friction_age_s, -1.0);
}

}  // namespace
}  // namespace strainwave::testing
