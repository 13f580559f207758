#include "control/new_plans.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

TEST(NewPlans, BeginOnceForEachTimeTheyAreAskedFor) {
  NewPlans plans;
  EXPECT_FALSE(plans.due());
  plans.ask();
  plans.ask();
  EXPECT_TRUE(plans.due());
  plans.begin(1);
  EXPECT_FALSE(plans.due());
  plans.ask();
  plans.cancel();
  EXPECT_FALSE(plans.due());
}

/// How many of those that are asked for become due.
int granted(NewPlans& plans, int asked) {
  int count = 0;
  for (int k = 0; k < asked; ++k) {
    plans.ask();
    if (!plans.due()) continue;
    ++count;
    plans.begin(1);
  }
  return count;
}

TEST(NewPlans, AreUsedUpByAJointThatIsBlocked) {
  NewPlans plans;
  EXPECT_EQ(granted(plans, 1000), NewPlans::kMost);
  plans.new_phase();
  EXPECT_EQ(granted(plans, 1000), NewPlans::kMost);
  plans.new_order();
  EXPECT_EQ(granted(plans, 1000), NewPlans::kMost);
  plans.reset();
  EXPECT_EQ(granted(plans, 1000), NewPlans::kMost);
}

TEST(NewPlans, TurnBackWhereTheyBeginOnTheOtherSideThanTheLastOfTheOrder) {
  NewPlans plans;
  EXPECT_FALSE(plans.begin(1)) << "the first";
  EXPECT_FALSE(plans.begin(1));
  EXPECT_TRUE(plans.begin(-1));
  plans.new_phase();
  EXPECT_TRUE(plans.begin(1)) << "still the same order";
  plans.new_order();
  EXPECT_FALSE(plans.begin(-1)) << "the first of another order";
}

TEST(NewPlans, OfATargetThatMovesHaveNoSide) {
  NewPlans plans;
  plans.begin(1);
  EXPECT_FALSE(plans.begin(0));
  EXPECT_TRUE(plans.begin(-1)) << "the last that had one was on the other";
}

TEST(NewPlans, AreForgottenByANewStart) {
  NewPlans plans;
  plans.begin(1);
  plans.ask();
  plans.reset();
  EXPECT_FALSE(plans.due());
  EXPECT_FALSE(plans.begin(-1));
}

}  // namespace
}  // namespace strainwave
