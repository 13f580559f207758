// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/last_resort.h"

#include <gtest/gtest.h>

#include <vector>

namespace strainwave::cia402 {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;

class LastResortTest : public ::testing::Test {
 protected:
  /// Advances by periods and sends what is due.
  void run(int periods) {
    for (int i = 0; i < periods; ++i, now_ns_ += kPeriod_ns) {
      if (!resort_.due(now_ns_)) continue;
      sent_.push_back(resort_.frame());
      resort_.sent(now_ns_);
    }
  }
  LastResort resort_{3};
  std::int64_t now_ns_ = 1'000'000'000;
  std::vector<CanFrame> sent_;
};

TEST_F(LastResortTest, DoesNothingUntilItIsBegun) {
  resort_.hear(now_ns_);
  run(1000);
  EXPECT_TRUE(sent_.empty());
  EXPECT_FALSE(resort_.withdraws_heartbeat());
}

TEST_F(LastResortTest, OrdersTheVoltageOffInThePeriodInWhichItBeginsAndThenResetsTheNode) {
  resort_.begin(now_ns_);
  run(1);
  ASSERT_EQ(sent_.size(), 1U);
  CanFrame disable;
  disable.id = 0x603;
  disable.size = 8;
  disable.bytes = {0x2B, 0x40, 0x60, 0, 0, 0, 0, 0};
  EXPECT_EQ(sent_[0], disable);
  run(100);
  ASSERT_EQ(sent_.size(), 4U);
  CanFrame reset;
  reset.id = 0;
  reset.size = 2;
  reset.bytes = {0x81, 3};
  EXPECT_EQ(sent_[1], disable);
  EXPECT_EQ(sent_[2], disable);
  EXPECT_EQ(sent_[3], reset);
}

TEST_F(LastResortTest, WithdrawsTheHeartbeatFromADriveThatGoesOnAsIfNothingHadBeenSaid) {
  resort_.begin(now_ns_);
  run(40);
  resort_.hear(now_ns_);
  EXPECT_FALSE(resort_.withdraws_heartbeat()) << "that one was under way already";
  run(150);
  resort_.hear(now_ns_);
  EXPECT_FALSE(resort_.withdraws_heartbeat()) << "it may have been out of sight: it is reset once more";
  run(150);
  EXPECT_EQ(sent_.size(), 5U);
  resort_.hear(now_ns_);
  EXPECT_TRUE(resort_.withdraws_heartbeat());
  resort_.end();
  EXPECT_FALSE(resort_.withdraws_heartbeat());
}

TEST_F(LastResortTest, LeavesTheHeartbeatAloneForADriveThatIsSilentOrHasRestarted) {
  resort_.begin(now_ns_);
  run(500);
  EXPECT_FALSE(resort_.withdraws_heartbeat()) << "whoever hears nothing of us has missed it long ago";
  resort_.hear_boot_up();
  resort_.hear(now_ns_);
  EXPECT_FALSE(resort_.withdraws_heartbeat());
}

TEST_F(LastResortTest, BeginsOnceHoweverOftenItIsTold) {
  for (int i = 0; i < 200; ++i) {
    resort_.begin(now_ns_);
    run(1);
  }
  EXPECT_EQ(sent_.size(), 4U);
}

}  // namespace
}  // namespace strainwave::cia402
