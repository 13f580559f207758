// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/sample_age.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <random>

namespace strainwave {
namespace {

constexpr std::int64_t kPeriod_ns = 1'000'000;
constexpr std::int64_t kUsual_ns = 150'000;
constexpr int kSlowEvery = 10;

class SampleAgeTest : public ::testing::Test {
 protected:
  SampleAgeTest() { age_.restart(kUsual_ns); }
  /// Runs `periods` SYNCs. The TPDOs follow each SYNC after `delay_ns`; a negative delay drops them.
  void run(int periods, std::int64_t delay_ns) {
    for (int i = 0; i < periods; ++i) {
      const std::int64_t sync_ns = next_sync_ns_;
      next_sync_ns_ += kPeriod_ns;
      deliver_until(sync_ns);
      age_.sync(sync_ns);
      const bool slow_due = ++syncs_heard_ % kSlowEvery == 0;
      if (delay_ns >= 0) due_.push_back({sync_ns + delay_ns, slow_due});
      deliver_until(next_sync_ns_);
    }
  }
  void deliver_until(std::int64_t time_ns) {
    std::sort(due_.begin(), due_.end());
    for (; !due_.empty() && due_.front().first < time_ns; due_.pop_front()) {
      age_.sample(due_.front().first);
      if (due_.front().second) age_.slow_sample(due_.front().first + 60'000);
    }
  }
  SampleAge age_{kPeriod_ns, kSlowEvery};
  std::int64_t next_sync_ns_ = 1'000'000'000;
  int syncs_heard_ = 0;  ///< by the drive
  std::deque<std::pair<std::int64_t, bool>> due_;
};

TEST_F(SampleAgeTest, IsTheDelayOfADriveThatAnswersEachSync) {
  run(100, kUsual_ns);
  EXPECT_EQ(age_.delay_ns(), kUsual_ns);
  EXPECT_EQ(age_.lag_periods(), 0);
}

TEST_F(SampleAgeTest, SeesADriveThatBecomesLateByMoreThanAPeriodAndIsOnTimeAgain) {
  run(100, kUsual_ns);
  for (const std::int64_t late_ns : {2'400'000, 10'400'000, 1'500'000}) {
    run(60, late_ns);
    EXPECT_EQ(age_.delay_ns(), late_ns);
    run(100, kUsual_ns);
    EXPECT_EQ(age_.delay_ns(), kUsual_ns) << "after " << late_ns;
  }
}

TEST_F(SampleAgeTest, SeesADriveThatBecomesLateByWholePeriods) {
  run(100, kUsual_ns);
  for (const int periods : {1, 2, 4}) {
    run(periods + 3 * kSlowEvery, kUsual_ns + periods * kPeriod_ns);
    EXPECT_EQ(age_.late_periods(), periods);
    run(200, kUsual_ns + periods * kPeriod_ns);
    EXPECT_EQ(age_.delay_ns(), kUsual_ns + periods * kPeriod_ns) << "it stays late";
    run(2 * kSlowEvery, kUsual_ns);
    EXPECT_EQ(age_.late_periods(), 0) << "after " << periods;
  }
}

TEST_F(SampleAgeTest, SeesWholePeriodsThatADriveIsLateFromTheFirstSyncOnUntilItHasCaughtUp) {
  for (const int periods : {1, 3, 12}) {
    age_ = SampleAge(kPeriod_ns, kSlowEvery);
    age_.restart(kUsual_ns);
    due_.clear();
    run(1000, kUsual_ns + periods * kPeriod_ns);
    EXPECT_EQ(age_.late_periods(), periods);
    run(5 * kSlowEvery, kUsual_ns);
    // TPDO2 cannot tell a catch-up by more than half of its interval from lateness. The fault then stays, which is the safe side.
    EXPECT_EQ(age_.late_periods() == 0, periods < kSlowEvery / 2) << "after " << periods;
  }
}

TEST_F(SampleAgeTest, TakesASyncOfWhichItWasNotToldForNoLateness) {
  run(100, kUsual_ns);
  for (int i = 0; i < 5; ++i) {
    due_.push_back({next_sync_ns_ + kUsual_ns, ++syncs_heard_ % kSlowEvery == 0});
    next_sync_ns_ += kPeriod_ns;
    for (int k = 0; k < 60; ++k) {
      run(1, kUsual_ns);
      ASSERT_EQ(age_.late_periods(), 0) << i << ", " << k;
    }
  }
}

TEST_F(SampleAgeTest, TakesLostSamplesForLostAndNotForLate) {
  std::mt19937 random(5);
  for (int i = 0; i < 200; ++i) {
    run(static_cast<int>(random() % 20), kUsual_ns);
    run(1 + static_cast<int>(random() % 3), -1);
    run(1, kUsual_ns);
    ASSERT_EQ(age_.lag_periods(), 0) << i;
  }
}

TEST_F(SampleAgeTest, OneThatIsElsewhereFromTheFirstSampleOnIsDisplaced) {
  for (const std::int64_t late_ns : {1'400'000, 6'600'000, 10'400'000}) {
    age_.restart(kUsual_ns);
    // The object has not seen the first SYNCs, as after a new setup of the drive while the loop continues.
    due_.clear();
    for (int i = 0; i < 100; ++i) {
      age_.sync(next_sync_ns_);
      age_.sample(next_sync_ns_ + late_ns % kPeriod_ns);
      next_sync_ns_ += kPeriod_ns;
    }
    EXPECT_TRUE(age_.displaced()) << late_ns;
  }
  age_.restart(kUsual_ns);
  run(100, kUsual_ns);
  EXPECT_FALSE(age_.displaced());
  run(100, 2'400'000);
  EXPECT_FALSE(age_.displaced()) << "it is known why";
}

TEST_F(SampleAgeTest, BearsTheJitterOfAnOrdinaryAdapter) {
  std::mt19937 random(6);
  run(1, kUsual_ns);
  for (int i = 0; i < 2000; ++i) {
    run(1, random() % 10 == 0 ? -1 : kUsual_ns + static_cast<std::int64_t>(random() % 150'000));
    ASSERT_EQ(age_.lag_periods(), 0) << i;
  }
}

TEST_F(SampleAgeTest, KeepsTheLagThatADriveHadFromTheStart) {
  age_.restart(2'400'000);
  run(200, 2'400'000);
  EXPECT_EQ(age_.delay_ns(), 2'400'000);
}

TEST_F(SampleAgeTest, IsLateByThePeriodsInWhichNobodySentASync) {
  run(100, kUsual_ns);
  EXPECT_EQ(age_.late_periods(3), 3);
  EXPECT_EQ(age_.late_periods(0), 0);
}

// A sample usually arrives two periods late. It does not get older if the loop omits the next two SYNCs.
TEST_F(SampleAgeTest, IsLaterByPeriodsLeftOutOnlyAsFarAsTheyExceedItsUsualLag) {
  age_.restart(2'400'000);
  run(200, 2'400'000);
  EXPECT_EQ(age_.late_periods(2), 0);
  EXPECT_EQ(age_.late_periods(5), 3);
}

TEST_F(SampleAgeTest, SaysNothingOfFramesWithoutATime) {
  age_.sync(0);
  age_.sample(0);
  EXPECT_EQ(age_.delay_ns(), kUsual_ns);
}

}  // namespace
}  // namespace strainwave
