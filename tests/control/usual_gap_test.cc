#include "control/trajectory/usual_gap.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace strainwave {
namespace {

constexpr double kJitter = 6.0;  ///< periods, likewise the rest

/// How many samples with these gaps it takes, over and over, until `interval` is contradicted; 0: more than a hundred.
int samples_taken(UsualGap& gaps, std::initializer_list<double> of, double interval) {
  int taken = 0;
  while (taken < 100)
    for (const double gap : of) {
      ++taken;
      if (gaps.take(gap, interval, kJitter)) return taken;
    }
  return 0;
}

/// As above, of a stream that has been in its rhythm of `interval` for long.
int samples_taken_later(std::initializer_list<double> of, double interval) {
  UsualGap gaps;
  for (int i = 0; i < 30; ++i) EXPECT_FALSE(gaps.take(interval, interval, kJitter));
  return samples_taken(gaps, of, interval);
}

TEST(UsualGap, IsToldByThreeSamplesOfAStreamThatBegins) {
  UsualGap gaps;
  EXPECT_EQ(samples_taken(gaps, {50.0}, 17.0), 3);
  EXPECT_DOUBLE_EQ(gaps.interval(), 50.0);
  EXPECT_DOUBLE_EQ(gaps.late(), 0.0);
}

// The first sample of a stream is not in its rhythm, the two after it were lost.
TEST(UsualGap, IsToldWhereTheFirstGapIsNoneOfThem) {
  UsualGap gaps;
  EXPECT_FALSE(gaps.take(35.0, 35.0, kJitter));
  EXPECT_FALSE(gaps.take(10.0, 35.0, kJitter));
  EXPECT_TRUE(gaps.take(10.0, 27.0, kJitter));
  EXPECT_DOUBLE_EQ(gaps.interval(), 10.0);
  EXPECT_EQ(gaps.told_by(), 2);
}

TEST(UsualGap, IsToldWhereSomeAreLostAndArrivalsJitter) {
  UsualGap gaps;
  for (const double gap : {48.0, 53.0, 98.0, 49.0, 52.0}) (void)gaps.take(gap, 50.0, kJitter);
  EXPECT_TRUE(gaps.take(49.0, 17.0, kJitter));
  EXPECT_NEAR(gaps.interval(), 50.0, 1.0);
}

TEST(UsualGap, TellsHowMuchLaterThanInItsRhythmTheLastCame) {
  UsualGap gaps;
  for (int i = 0; i < 9; ++i) (void)gaps.take(20.0, 20.0, kJitter);
  EXPECT_TRUE(gaps.take(22.0, 30.0, kJitter));
  EXPECT_NEAR(gaps.late(), 2.0, 1.2);
}

TEST(UsualGap, IsTheIntervalWhereOneComesAfterIt) {
  UsualGap gaps;
  EXPECT_EQ(samples_taken(gaps, {50.0, 100.0, 50.0, 100.0}, 50.0), 0);
}

TEST(UsualGap, SaysNothingOfAStreamThatIsFasterThanJitter) {
  UsualGap gaps;
  EXPECT_EQ(samples_taken(gaps, {6.0}, 2.0), 0);
}

// Half of them are in no rhythm: two at once each time.
TEST(UsualGap, SaysNothingWhereSamplesComeInPairs) {
  UsualGap gaps;
  EXPECT_EQ(samples_taken(gaps, {20.0, 0.0}, 10.0), 0);
}

TEST(UsualGap, IsToldAnewWhereASenderSlowsDownOrSpeedsUp) {
  EXPECT_GT(samples_taken_later({20.0}, 10.0), 8);
  EXPECT_LE(samples_taken_later({20.0}, 10.0), 12);
  EXPECT_GT(samples_taken_later({10.0}, 20.0), 8);
  EXPECT_LE(samples_taken_later({10.0}, 20.0), 12);
}

// A rhythm that no gap tells would be that of the one before.
TEST(UsualGap, IsNotToldByAGapThatIsInNoRhythm) {
  UsualGap gaps;
  for (int i = 0; i < 14; ++i) EXPECT_FALSE(gaps.take(20.0, 20.0, kJitter));
  for (int i = 0; i < 10; ++i) EXPECT_FALSE(gaps.take(20.0, 20.0, kJitter));
  EXPECT_FALSE(gaps.take(30.0, 10.0, kJitter));
  EXPECT_TRUE(gaps.take(20.0, 10.0, kJitter));
  EXPECT_EQ(gaps.told_by(), 1);
}

TEST(UsualGap, IsNotWhatLossesAndHoldUpsMakeOfARhythm) {
  EXPECT_EQ(samples_taken_later({20.0, 10.0, 20.0, 10.0, 30.0}, 10.0), 0);
  EXPECT_EQ(samples_taken_later({50.0, 0.0, 0.0, 0.0, 0.0, 10.0, 10.0, 10.0}, 10.0), 0);
}

}  // namespace
}  // namespace strainwave
