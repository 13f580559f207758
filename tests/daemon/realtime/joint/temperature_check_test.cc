// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/temperature_check.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace strainwave {
namespace {

constexpr std::int64_t kSecond_ns = 1'000'000'000;

TemperatureCheckConfig config() {
  TemperatureCheckConfig config;
  config.min_C = -40.0;
  config.max_C = 90.0;
  config.max_rate_C_s = 10.0;
  config.max_step_C = 6.0;
  config.max_age_s = 2.0;
  return config;
}

class TemperatureCheckTest : public ::testing::Test {
 protected:
  void read(double temperature_C, double after_s) {
    now_ns_ += static_cast<std::int64_t>(after_s * 1e9);
    check_.update(true, temperature_C, now_ns_, now_ns_);
  }
  void silence(double duration_s) {
    now_ns_ += static_cast<std::int64_t>(duration_s * 1e9);
    check_.update(false, 0.0, 0, now_ns_);
  }
  TemperatureCheck check_{config()};
  std::int64_t now_ns_ = 5 * kSecond_ns;
};

TEST_F(TemperatureCheckTest, KnowsNothingBeforeTheFirstPlausibleReadingWhichItUsesAtOnce) {
  silence(0.0);
  EXPECT_EQ(check_.status(), TemperatureStatus::kNeverSeen);
  EXPECT_FALSE(check_.known());
  read(20.0, 0.1);
  EXPECT_TRUE(check_.known());
  EXPECT_EQ(check_.used_C(), 20.0);
}

TEST_F(TemperatureCheckTest, RefusesNonsenseAndKeepsTheLastPlausibleValue) {
  read(20.0, 0.1);
  for (const double bad : {std::nan(""), 500.0, -273.0, std::numeric_limits<double>::infinity()}) {
    read(bad, 0.1);
    EXPECT_EQ(check_.status(), TemperatureStatus::kOutOfRange);
    EXPECT_EQ(check_.used_C(), 20.0);
  }
}

TEST_F(TemperatureCheckTest, RefusesAJumpButFollowsAStepWithinTheAllowance) {
  read(20.0, 0.1);
  read(25.0, 0.1);
  EXPECT_EQ(check_.used_C(), 25.0);
  read(45.0, 0.1);
  EXPECT_EQ(check_.status(), TemperatureStatus::kTooFast);
  EXPECT_EQ(check_.used_C(), 25.0);
}

TEST_F(TemperatureCheckTest, RefusesADriftFasterThanTheRateHoweverSmallItsSteps) {
  double temperature_C = 20.0;
  read(temperature_C, 0.1);
  bool refused = false;
  for (int i = 0; i < 2000 && !refused; ++i) {
    temperature_C += 0.02;  // 20 degC/s in 1 ms steps, twice the allowed rate
    read(temperature_C, 0.001);
    refused = check_.status() == TemperatureStatus::kTooFast;
  }
  EXPECT_TRUE(refused);
}

TEST_F(TemperatureCheckTest, FollowsADriftWithinTheRate) {
  double temperature_C = 20.0;
  read(temperature_C, 0.1);
  for (int i = 0; i < 5000; ++i) {
    temperature_C += 0.009;
    read(temperature_C, 0.001);
    ASSERT_EQ(check_.status(), TemperatureStatus::kValid) << "at " << temperature_C;
  }
}

TEST_F(TemperatureCheckTest, RefusesAReadingThatIsOldWhenItArrives) {
  check_.update(true, 20.0, now_ns_ - 3 * kSecond_ns, now_ns_);
  EXPECT_EQ(check_.status(), TemperatureStatus::kTooOld);
}

TEST_F(TemperatureCheckTest, KeepsTheLastValueThroughALossAndUsesTheNextThatIsPlausible) {
  read(20.0, 0.1);
  silence(3.0);
  EXPECT_EQ(check_.status(), TemperatureStatus::kTooOld);
  EXPECT_EQ(check_.used_C(), 20.0);
  read(21.0, 0.1);
  EXPECT_EQ(check_.status(), TemperatureStatus::kValid);
  EXPECT_EQ(check_.used_C(), 21.0);
}

}  // namespace
}  // namespace strainwave
