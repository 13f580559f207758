#include "control/link_corrections.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr double kCount_rad = 2e-5;

class LinkCorrectionsTest : public ::testing::Test {
 protected:
  /// At rest, so far off, for so many periods; how many corrections began.
  int rests(double off_rad, int periods, int still_periods = 10) {
    int begun = 0;
    for (int i = 0; i < periods; ++i) begun += corrections_.begins(off_rad, off_rad, still_periods) ? 1 : 0;
    return begun;
  }
  /// A correction that leaves so much; whether it began.
  bool leaves(double off_rad) {
    corrections_.motion();
    return rests(off_rad, 1) == 1;
  }
  LinkCorrections corrections_{kPeriod_s, kCount_rad};
};

TEST_F(LinkCorrectionsTest, BeginWhereTheMotorSticksOffItsPlace) {
  EXPECT_FALSE(corrections_.begun());
  EXPECT_EQ(rests(1e-3, 1), 1);
  EXPECT_TRUE(corrections_.begun());
}

TEST_F(LinkCorrectionsTest, LeaveACountAlone) {
  EXPECT_EQ(rests(1.1 * kCount_rad, 1000), 0);
}

TEST_F(LinkCorrectionsTest, WaitUntilACountThatMayFlickerHasStoodForLong) {
  EXPECT_EQ(rests(2.0 * kCount_rad, 19), 0);
  EXPECT_EQ(rests(2.0 * kCount_rad, 1), 1);
}

TEST_F(LinkCorrectionsTest, WaitUntilTheMotorStands) {
  EXPECT_EQ(rests(1e-3, 10, 2), 0);
  EXPECT_EQ(rests(1e-3, 1, 3), 1);
}

TEST_F(LinkCorrectionsTest, EndAfterFiveThatBringNothingUntilThereIsANewTarget) {
  EXPECT_TRUE(leaves(1e-3));
  for (int i = 1; i < LinkCorrections::kMostInVain; ++i) EXPECT_TRUE(leaves(1e-3)) << i;
  EXPECT_FALSE(leaves(1e-3));
  // The same target once more.
  corrections_.trust_anew();
  EXPECT_FALSE(leaves(1e-3));
  corrections_.reset();
  EXPECT_TRUE(leaves(1e-3));
}

TEST_F(LinkCorrectionsTest, EndWhenTheyAreTooMany) {
  double distance_rad = 1.0;
  for (int i = 0; i < LinkCorrections::kMost; ++i, distance_rad *= 0.6)
    EXPECT_TRUE(leaves(distance_rad)) << i;
  EXPECT_FALSE(leaves(distance_rad));
}

TEST_F(LinkCorrectionsTest, TakeFrictionForMoreWhereOneFallsShortAndForLessWhereOneGoesTooFar) {
  leaves(1e-3);
  EXPECT_EQ(corrections_.friction_doubt(), 0.0) << "an order's motion tells of more than friction";
  leaves(1e-3);
  const double more = corrections_.friction_doubt();
  EXPECT_GT(more, 0.1);
  leaves(-2e-3);
  const double less = corrections_.friction_doubt();
  EXPECT_NEAR(less, 0.5 * more, 1e-12) << "in smaller steps than before";
  leaves(1e-3);
  EXPECT_LT(corrections_.friction_doubt(), less) << "too far once more, from the other side";
  corrections_.trust_anew();
  EXPECT_NE(corrections_.friction_doubt(), 0.0);
  corrections_.reset();
  EXPECT_EQ(corrections_.friction_doubt(), 0.0);
}

TEST_F(LinkCorrectionsTest, DoubtFrictionByNoMoreThanItMayBeOff) {
  for (const double sign : {1.0, -1.0}) {
    double farthest = 0.0;
    double off_rad = 1e-3;
    for (int i = 0; i < LinkCorrections::kMost; ++i, off_rad *= sign * 0.69) {
      leaves(off_rad);
      farthest = std::max(farthest, std::abs(corrections_.friction_doubt()));
      EXPECT_LE(farthest, LinkCorrections::kMostFrictionDoubt) << i;
    }
    if (sign > 0.0) {
      EXPECT_EQ(farthest, LinkCorrections::kMostFrictionDoubt);
    }
    corrections_.reset();
  }
}

TEST_F(LinkCorrectionsTest, DoNotBeginOnAJointThatIsNotTheModels) {
  corrections_.distrust(1.1 * LinkCorrections::kTrusted);
  corrections_.distrust(0.0);
  EXPECT_FALSE(leaves(1e-3));
  corrections_.trust_anew();
  EXPECT_TRUE(leaves(1e-3));
}

// A link that swings behind the motor's encoder, or an integral that moves it.
TEST_F(LinkCorrectionsTest, EndWhereTheReadingMovesLongAfterTheMotion) {
  EXPECT_EQ(rests(0.0, 150), 0);
  EXPECT_EQ(rests(3.0 * kCount_rad, 1000), 0);
  EXPECT_EQ(rests(1e-3, 1000), 0);
}

}  // namespace
}  // namespace strainwave
