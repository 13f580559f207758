#include "daemon/admission/challenges.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

constexpr std::int64_t kLifetime = 1000;

TEST(Challenges, AreGoodForAboutTheirLifetimeFromWhenTheyWereDrawn) {
  Challenges challenges(kLifetime, 2);
  const std::int64_t first = challenges.advance(0, 4711);
  EXPECT_EQ(first, 4711);
  for (std::int64_t cycle = 0; cycle <= 5000; ++cycle) {
    challenges.advance(cycle, 10'000 + cycle);
    const bool good = challenges.expiry_cycle(first) >= 0;
    EXPECT_EQ(good, cycle <= kLifetime * 9 / 8) << cycle;
  }
}

TEST(Challenges, ThatAreNewestLiveAtLeastForTheLifetime) {
  Challenges challenges(kLifetime, 2);
  for (std::int64_t cycle = 0; cycle < 10'000; ++cycle) {
    const std::int64_t newest = challenges.advance(cycle, 1 + cycle);
    EXPECT_GE(challenges.expiry_cycle(newest), cycle + kLifetime) << cycle;
  }
}

TEST(Challenges, DrawnBeforeAStopAreOverForThatJointAlone) {
  Challenges challenges(kLifetime, 2);
  const std::int64_t before = challenges.advance(0, 11);
  challenges.stop(1);
  EXPECT_TRUE(challenges.stopped_since(before, 1));
  EXPECT_FALSE(challenges.stopped_since(before, 0));
  const std::int64_t after = challenges.advance(kLifetime / 50, 12);
  EXPECT_NE(after, before) << "a new one comes at once";
  EXPECT_FALSE(challenges.stopped_since(after, 1));
  EXPECT_TRUE(challenges.stopped_since(before, 1));
}

TEST(Challenges, AreNotForgottenHoweverManyStopsThereAre) {
  Challenges challenges(kLifetime, 2);
  const std::int64_t first = challenges.advance(0, 11);
  for (std::int64_t cycle = 1; cycle < kLifetime; ++cycle) {
    challenges.stop(1);
    challenges.advance(cycle, 100 + cycle);
    ASSERT_GE(challenges.expiry_cycle(first), 0) << cycle;
  }
}

TEST(Challenges, ThatWereNeverDrawnAreWorthless) {
  Challenges challenges(kLifetime, 2);
  EXPECT_LT(challenges.expiry_cycle(0), 0) << "nothing was drawn yet";
  std::mt19937_64 random(7);
  for (std::int64_t cycle = 0; cycle < 3000; ++cycle)
    challenges.advance(cycle, static_cast<std::int64_t>(random()));
  for (std::int64_t guess = -1000; guess < 100'000; ++guess) EXPECT_LT(challenges.expiry_cycle(guess), 0);
}

TEST(Challenges, AreNeverZeroOrNegativeWhateverIsDrawn) {
  for (const std::int64_t random : {std::int64_t{0}, std::int64_t{-1}, INT64_MIN}) {
    Challenges challenges(kLifetime, 2);
    EXPECT_GT(challenges.advance(0, random), 0);
  }
}

TEST(Challenges, ExpireByTheCyclesThatAStallHasSkipped) {
  Challenges challenges(kLifetime, 2);
  const std::int64_t before = challenges.advance(0, 5);
  challenges.advance(20'000, 6);
  EXPECT_LT(challenges.expiry_cycle(before), 0);
  EXPECT_GE(challenges.expiry_cycle(6), 20'000);
}

}  // namespace
}  // namespace strainwave
