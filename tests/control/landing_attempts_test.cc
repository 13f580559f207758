#include "control/landing_attempts.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

using State = LandingAttempts::State;

void fail_by_time(LandingAttempts& attempts) {
  attempts.begin();
  for (int k = 0; k < LandingAttempts::kPeriods; ++k) attempts.spend_period();
}

TEST(LandingAttempts, PauseAfterTooManyPeriodsAndNoSooner) {
  LandingAttempts attempts;
  attempts.begin();
  for (int k = 1; k < LandingAttempts::kPeriods; ++k) attempts.spend_period();
  EXPECT_TRUE(attempts.allowed());
  attempts.spend_period();
  EXPECT_EQ(attempts.state(), State::kPaused);
}

TEST(LandingAttempts, PauseAfterTooManyBeginsAndNoSooner) {
  LandingAttempts attempts;
  for (int k = 0; k < LandingAttempts::kBegins; ++k) attempts.begin();
  EXPECT_TRUE(attempts.allowed());
  attempts.begin();
  EXPECT_EQ(attempts.state(), State::kPaused);
}

TEST(LandingAttempts, OpenAgainWhenThePauseIsOver) {
  LandingAttempts attempts;
  fail_by_time(attempts);
  for (int k = 1; k < LandingAttempts::kPausePeriods; ++k) attempts.wait();
  EXPECT_FALSE(attempts.allowed());
  attempts.wait();
  EXPECT_TRUE(attempts.allowed());
}

TEST(LandingAttempts, EndWithTheThirdFailureInARowWhateverTheTargets) {
  LandingAttempts attempts;
  for (int failure = 0; failure < LandingAttempts::kFailures; ++failure) {
    EXPECT_TRUE(attempts.allowed()) << failure;
    fail_by_time(attempts);
    attempts.new_target();
  }
  EXPECT_EQ(attempts.state(), State::kExhausted);
  for (int k = 0; k < 10 * LandingAttempts::kPausePeriods; ++k) attempts.wait();
  attempts.new_target();
  EXPECT_EQ(attempts.state(), State::kExhausted);
  attempts.reset();
  EXPECT_TRUE(attempts.allowed());
}

TEST(LandingAttempts, ForgetFailuresOnceALandingComesOff) {
  LandingAttempts attempts;
  for (int round = 0; round < 10; ++round) {
    for (int failure = 1; failure < LandingAttempts::kFailures; ++failure) {
      fail_by_time(attempts);
      attempts.new_target();
    }
    ASSERT_TRUE(attempts.allowed()) << round;
    attempts.landed();
  }
}

}  // namespace
}  // namespace strainwave
