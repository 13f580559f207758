// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/drive_sequence.h"

#include <gtest/gtest.h>

#include <random>

namespace strainwave {
namespace {

constexpr DriveSequenceConfig kConfig{0.010, 0.005, 0.030, 0.020, 0.050};

class DriveSequenceTest : public ::testing::Test {
 protected:
  /// Runs one period and returns its outputs.
  DriveSequence::Outputs step(bool enable) { return outputs_ = sequence_.step(enable, now_ns_ += 1'000'000); }
  /// Returns the periods until `condition` holds, or -1 after 1000.
  template <typename Condition>
  int periods_until(bool enable, const Condition& condition) {
    for (int periods = 1; periods <= 1000; ++periods) {
      step(enable);
      if (condition()) return periods;
    }
    return -1;
  }
  void switch_on() {
    ASSERT_GT(periods_until(true, [&] { return sequence_.may_move(); }), 0);
  }

  DriveSequence sequence_{kConfig};
  DriveSequence::Outputs outputs_;
  std::int64_t now_ns_ = 0;
};

TEST_F(DriveSequenceTest, OpensTheBrakeUnderTorqueAndThenWaitsForIt) {
  step(true);
  EXPECT_TRUE(outputs_.enable);
  EXPECT_FALSE(outputs_.brake_open);
  EXPECT_EQ(periods_until(true, [&] { return sequence_.has_torque(); }), 10);
  EXPECT_FALSE(outputs_.brake_open) << "torque comes first";
  EXPECT_EQ(periods_until(true, [&] { return outputs_.brake_open; }), 5);
  EXPECT_FALSE(sequence_.may_move());
  EXPECT_EQ(sequence_.drive_state(), DriveState::kEnabled) << "it is held while the brake opens";
  EXPECT_EQ(periods_until(true, [&] { return sequence_.may_move(); }), 30);
  EXPECT_EQ(sequence_.drive_state(), DriveState::kEnabled);
}

TEST_F(DriveSequenceTest, HoldsTheTorqueWhileTheBrakeShuts) {
  switch_on();
  step(false);
  EXPECT_FALSE(outputs_.brake_open);
  EXPECT_TRUE(outputs_.enable);
  EXPECT_TRUE(sequence_.holds_torque());
  EXPECT_NE(sequence_.drive_state(), DriveState::kEnabled) << "nobody may take it for ready";
  EXPECT_EQ(periods_until(false, [&] { return !outputs_.enable; }), 20);
  EXPECT_EQ(sequence_.drive_state(), DriveState::kDisabled);
}

TEST_F(DriveSequenceTest, CutsTheAmplifierAtOnceWhenStoppedAndShutsTheBrakeLater) {
  switch_on();
  outputs_ = sequence_.stop(now_ns_);
  EXPECT_FALSE(outputs_.enable);
  EXPECT_TRUE(outputs_.brake_open) << "friction slows the joint first";
  EXPECT_EQ(periods_until(false, [&] { return !outputs_.brake_open; }), 50);
}

TEST_F(DriveSequenceTest, ShutsTheBrakeInTimeHoweverOftenItIsStopped) {
  switch_on();
  for (int i = 0; i <= 50; ++i) outputs_ = sequence_.stop(now_ns_ += 1'000'000);
  EXPECT_FALSE(outputs_.brake_open);
}

TEST_F(DriveSequenceTest, ShutsTheBrakeInTheCallThatStopsItUnlessTheConfigurationSaysOtherwise) {
  DriveSequence sequence({0.010, 0.005, 0.030, 0.020});
  std::int64_t now_ns = 0;
  while (!sequence.may_move()) (void)sequence.step(true, now_ns += 1'000'000);
  const DriveSequence::Outputs outputs = sequence.stop(now_ns);
  EXPECT_FALSE(outputs.brake_open);
  EXPECT_FALSE(outputs.enable);
}

TEST_F(DriveSequenceTest, NeverHasTheBrakeOpenBeforeThereIsTorque) {
  std::mt19937 random(11);
  bool enable = false;
  for (int i = 0; i < 100'000; ++i) {
    if (random() % 30 == 0) enable = !enable;
    step(enable);
    ASSERT_TRUE(!outputs_.brake_open || sequence_.has_torque()) << i;
  }
}

TEST_F(DriveSequenceTest, DoesNotOpenABrakeForAStop) {
  step(true);
  EXPECT_FALSE(sequence_.stop(now_ns_).brake_open);
  EXPECT_FALSE(sequence_.stop(now_ns_).enable);
}

TEST_F(DriveSequenceTest, CanBeSwitchedOnAgainOnlyWithTheBrakeShutInBetween) {
  switch_on();
  step(false);
  EXPECT_GT(periods_until(true, [&] { return !outputs_.brake_open && !outputs_.enable; }), 0);
  EXPECT_GT(periods_until(true, [&] { return sequence_.may_move(); }), 40);
}

TEST_F(DriveSequenceTest, NeverHasTheBrakeOpenWithoutTheAmplifierExceptAfterAStop) {
  std::mt19937 random(3);
  bool enable = false;
  std::int64_t stopped_ns = -1'000'000'000;
  for (int i = 0; i < 100'000; ++i) {
    if (random() % 40 == 0) enable = !enable;
    step(enable);
    if (random() % 200 == 0) {
      outputs_ = sequence_.stop(now_ns_);
      stopped_ns = now_ns_;
    }
    const bool freewheels = outputs_.brake_open && !outputs_.enable;
    ASSERT_TRUE(!freewheels || now_ns_ - stopped_ns <= 50'000'000);
  }
}

}  // namespace
}  // namespace strainwave
