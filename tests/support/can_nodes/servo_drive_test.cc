// SPDX-License-Identifier: BSD-3-Clause
// The simulated drive's own loop of position or velocity, with a SYNC each period.
#include "tests/support/can_nodes/servo_drive.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/joint/reference_plant.h"

namespace strainwave::can_nodes {
namespace {

constexpr std::int64_t kSync_us = 1000;
constexpr std::int64_t kEnable = 0x0F;
constexpr std::int64_t kInterpolate = 0x1F;

class OwnLoopDrive : public ::testing::TestWithParam<double> {
 protected:
  static ServoDriveConfig config() {
    ServoDriveConfig config;
    config.plant = realistic_plant();
    config.plant.delay.periods = 0.0;
    config.plant.period_s = GetParam();
    config.has_ip = config.has_csp = config.has_csv = true;
    return config;
  }
  void sync() {
    drive_.take_setpoint(kSync_us);
    for (std::int64_t t = 0; t < kSync_us; t += drive_.period_us()) drive_.step();
  }
  void order(std::int64_t controlword) {
    dictionary_.set({0x6040, 0}, controlword);
    drive_.obey_controlword();
  }
  void enable(std::int64_t mode) {
    dictionary_.set({0x6060, 0}, mode);
    for (int i = 0; i < 30; ++i) sync();
    for (const std::int64_t word : {std::int64_t{0x06}, std::int64_t{0x07}, kEnable}) order(word);
    for (int i = 0; i < 20; ++i) sync();
    ASSERT_EQ(drive_.power(), PowerState::kOperationEnabled);
  }
  double counts() { return drive_.plant().state().position_rad / (2.0 * M_PI) * 320000.0; }
  /// Follows rising targets. Returns how far the joint is behind the last one when its time has come.
  double follow(Key target, std::int64_t counts_per_sync) {
    const std::int64_t from = std::llround(counts());
    for (int i = 0; i < 1000; ++i) {
      dictionary_.set(target, from + counts_per_sync * i);
      sync();
    }
    return static_cast<double>(from + counts_per_sync * 999) - counts();
  }

  ObjectDictionary dictionary_;
  ServoDrive drive_{config(), dictionary_, {}};
};

TEST_P(OwnLoopDrive, IsWhereItWasSentWhenTheNextSyncComes) {
  enable(kModeCyclicPosition);
  dictionary_.set({0x60B1, 0}, 20000);
  EXPECT_NEAR(follow({0x607A, 0}, 20), 0.0, 20.0) << "a period's way at most";
  dictionary_.set({0x60B1, 0}, 0);
  EXPECT_GT(follow({0x607A, 0}, 20), 100.0) << "its loop alone lags";
}

TEST_P(OwnLoopDrive, InterpolatesOnlyWhenItIsToldTo) {
  enable(kModeInterpolatedPosition);
  EXPECT_EQ(dictionary_.number({0x6041, 0}) & 1 << 12, 0);
  EXPECT_GT(follow({0x60C1, 1}, 20), 10000.0) << "it stands";
  order(kInterpolate);
  EXPECT_LT(follow({0x60C1, 1}, 20), 1000.0);
  EXPECT_NE(dictionary_.number({0x6041, 0}) & 1 << 12, 0);
}

TEST_P(OwnLoopDrive, TurnsAsFastAsItIsTold) {
  enable(kModeCyclicVelocity);
  dictionary_.set({0x60FF, 0}, -30000);
  for (int i = 0; i < 500; ++i) sync();
  EXPECT_NEAR(static_cast<double>(dictionary_.number({0x606C, 0})), -30000.0, 1500.0);
}

TEST_P(OwnLoopDrive, FaultsWhenItIsTooFarBehind) {
  dictionary_.set({0x6065, 0}, 2000);
  enable(kModeCyclicPosition);
  dictionary_.set({0x607A, 0}, 5000);
  for (int i = 0; i < 5; ++i) sync();
  EXPECT_EQ(dictionary_.number({0x603F, 0}), kErrorFollowing);
}

INSTANTIATE_TEST_SUITE_P(Periods, OwnLoopDrive, ::testing::Values(1e-3, 0.25e-3));

}  // namespace
}  // namespace strainwave::can_nodes
