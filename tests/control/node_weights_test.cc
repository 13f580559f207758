#include "control/trajectory/node_weights.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

// Each sample more makes a quarter of the miss, or twice of it.
constexpr NodeWeights::Missed kExact{0.0, 1.0, 0.3, 0.08, 0.02, 0.005};
constexpr NodeWeights::Missed kOff{0.0, 1.0, 2.0, 4.0, 8.0, 16.0};

TEST(NodeWeights, TakeAllSamplesThereAreUntilOneHasTold) {
  const NodeWeights weights;
  EXPECT_TRUE(weights.helps(3));
  EXPECT_TRUE(weights.helps(4));
}

TEST(NodeWeights, TakeMoreSamplesWhereThesePredictBetter) {
  NodeWeights weights;
  for (int i = 0; i < 10; ++i) weights.weigh(kExact, 5);
  EXPECT_TRUE(weights.helps(3));
  EXPECT_TRUE(weights.helps(4));
}

TEST(NodeWeights, TakeFewSamplesWhereTheseAreOffAndMoreOnceTheyAreNot) {
  NodeWeights weights;
  for (int i = 0; i < 10; ++i) weights.weigh(kOff, 5);
  EXPECT_FALSE(weights.helps(3));
  EXPECT_FALSE(weights.helps(4));
  int exact = 0;
  for (; !weights.helps(4) && exact < 20; ++exact) weights.weigh(kExact, 5);
  EXPECT_GE(exact, 3);
  EXPECT_LE(exact, 12);
}

TEST(NodeWeights, DoNotTakeOneBadSampleForMany) {
  NodeWeights weights;
  for (int i = 0; i < 10; ++i) weights.weigh(kExact, 5);
  NodeWeights::Missed bad = kOff;
  for (double& missed : bad) missed *= 1e6;
  weights.weigh(bad, 5);
  EXPECT_TRUE(weights.helps(3));
}

TEST(NodeWeights, JudgeOnlyPolynomialsThatThereWere) {
  NodeWeights weights;
  for (int i = 0; i < 10; ++i) weights.weigh(kOff, 4);
  EXPECT_FALSE(weights.helps(3));
  // Of those through five samples nothing is known, which is no reason to take them.
  EXPECT_FALSE(weights.helps(4));
  weights.weigh({}, 5);
  weights.forget();
  EXPECT_TRUE(weights.helps(3));
}

}  // namespace
}  // namespace strainwave
