#include "control/rhythm_part.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace strainwave {
namespace {

constexpr double kLocked = 17.0;  ///< periods, a part of 50
constexpr double kJitter = 6.0;   ///< likewise

/// How many samples with these gaps it takes, over and over; 0: more than a hundred.
int samples_taken(RhythmPart& part, std::initializer_list<double> gaps, double interval = kLocked) {
  int taken = 0;
  while (taken < 100)
    for (const double gap : gaps) {
      ++taken;
      if (part.take(gap, interval, kJitter)) return taken;
    }
  return 0;
}

TEST(RhythmPart, IsFoundByTenGapsInARowAndTellsTheInterval) {
  RhythmPart part;
  EXPECT_EQ(samples_taken(part, {50.0}), 10);
  EXPECT_DOUBLE_EQ(part.interval(), 50.0);
  EXPECT_EQ(samples_taken(part, {50.0}), 10);
}

TEST(RhythmPart, IsFoundWhereSomeAreLostAndArrivalsJitter) {
  RhythmPart part;
  EXPECT_EQ(samples_taken(part, {48.0, 53.0, 98.0, 49.0, 52.0}), 10);
  EXPECT_NEAR(part.interval(), 50.0, 1.0);
}

TEST(RhythmPart, IsNotWhereOneComesAfterTheInterval) {
  RhythmPart part;
  EXPECT_EQ(samples_taken(part, {100.0, 50.0, 100.0, 100.0}, 50.0), 0);
}

TEST(RhythmPart, IsNotWhatLossesLeave) {
  RhythmPart part;
  EXPECT_EQ(samples_taken(part, {100.0, 150.0, 100.0, 100.0}, 50.0), 0);
}

TEST(RhythmPart, IsNotWhatJitterMakesOfAFastStream) {
  RhythmPart part;
  EXPECT_EQ(samples_taken(part, {7.0}, 2.0), 0);
}

}  // namespace
}  // namespace strainwave
