// SPDX-License-Identifier: BSD-3-Clause
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
  challenges.stop(1, {2, 10});
  EXPECT_EQ(challenges.since(before, 1, {1, 5}), Since::kOthersStop);
  EXPECT_EQ(challenges.since(before, 0, {1, 5}), Since::kNothing);
  const std::int64_t after = challenges.advance(0, 12);
  EXPECT_NE(after, before) << "a new one comes at once";
  EXPECT_EQ(challenges.since(after, 1, {1, 5}), Since::kNothing);
  EXPECT_EQ(challenges.since(before, 1, {1, 5}), Since::kOthersStop);
}

TEST(Challenges, TellAStopThatItsSenderGaveBeforeFromOneThatOvertookHim) {
  Challenges challenges(kLifetime, 1);
  const std::int64_t before = challenges.advance(0, 11);
  challenges.stop(0, {1, 10});
  EXPECT_EQ(challenges.since(before, 0, {1, 11}), Since::kOwnStop);
  EXPECT_EQ(challenges.since(before, 0, {1, 10}), Since::kOthersStop) << "in another window of his";
  EXPECT_EQ(challenges.since(before, 0, {1, 9}), Since::kOthersStop);
  challenges.stop(0, {2, 1});
  EXPECT_EQ(challenges.since(before, 0, {1, 11}), Since::kOthersStop);
  challenges.stop(0, {1, 12});
  EXPECT_EQ(challenges.since(before, 0, {1, 13}), Since::kOthersStop) << "somebody else's came between";
  const std::int64_t later = challenges.advance(1, 12);
  challenges.stop(0, {1, 14});
  EXPECT_EQ(challenges.since(later, 0, {1, 15}), Since::kOwnStop) << "the other's was before";
  EXPECT_EQ(challenges.since(before, 0, {1, 15}), Since::kOthersStop);
}

TEST(Challenges, TellSendersOfOneAccountApartByTheirKeys) {
  Challenges challenges(kLifetime, 1);
  const std::int64_t before = challenges.advance(0, 11);
  challenges.stop(0, {1, 10, 3});
  EXPECT_EQ(challenges.since(before, 0, {1, 11, 3}), Since::kOwnStop);
  EXPECT_EQ(challenges.since(before, 0, {1, 11, 2}), Since::kOthersStop);
  EXPECT_EQ(challenges.since(before, 0, {1, 11}), Since::kOthersStop);
  challenges.stop(0, {1, 12});
  EXPECT_EQ(challenges.since(before, 0, {1, 13, 3}), Since::kOthersStop)
      << "nobody has proved that it was his";
}

TEST(Challenges, DrawnInTheCycleOfAFaultOrBeforeAreOverAndTheNextIsDrawnInALaterOne) {
  Challenges challenges(kLifetime, 1);
  const std::int64_t before = challenges.advance(100, 11);
  challenges.fault(0, 100);
  EXPECT_EQ(challenges.since(before, 0, {1, 1}), Since::kOwnStop) << "its sender may give it anew";
  EXPECT_EQ(challenges.advance(100, 12), before);
  const std::int64_t after = challenges.advance(101, 13);
  EXPECT_EQ(after, 13);
  EXPECT_EQ(challenges.since(after, 0, {1, 1}), Since::kNothing);
  EXPECT_EQ(challenges.drawn_cycle(after), 101);
  EXPECT_EQ(challenges.drawn_cycle(4711), -1);
}

TEST(Challenges, AreNotForgottenHoweverManyStopsThereAre) {
  for (const std::int64_t lifetime :
       {std::int64_t{100}, std::int64_t{199}, kLifetime, std::int64_t{10'000}}) {
    Challenges challenges(lifetime, 2);
    std::int64_t first = 0;
    for (std::int64_t cycle = 0; cycle < 5 * lifetime; ++cycle) {
      const std::int64_t newest = challenges.advance(cycle, 100 + cycle);
      challenges.stop(1, {1, cycle});
      if (cycle % lifetime == 0) first = newest;
      ASSERT_GE(challenges.expiry_cycle(first), 0) << cycle << " of " << lifetime;
    }
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
