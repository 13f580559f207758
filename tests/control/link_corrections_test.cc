#include "control/link_corrections.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

constexpr double kPeriod_s = 0.001;
constexpr double kCount_rad = 2e-5;

class LinkCorrectionsTest : public ::testing::Test {
 protected:
  /// At rest, so far off, for so many periods; how many corrections began.
  int rests(double distance_rad, int periods, int still_periods = 10) {
    int begun = 0;
    for (int i = 0; i < periods; ++i)
      begun += corrections_.begins(distance_rad, distance_rad, still_periods) ? 1 : 0;
    return begun;
  }
  /// A correction that leaves so much; whether it began.
  bool leaves(double distance_rad) {
    corrections_.motion();
    return rests(distance_rad, 1) == 1;
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

TEST_F(LinkCorrectionsTest, EndAfterThreeThatBringNothingUntilThereIsANewTarget) {
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
