// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/motion_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

namespace strainwave {
namespace {

class MotionWatchTest : public ::testing::Test {
 protected:
  MotionWatchTest() {
    config_.limits.following_error_rad = 0.1;
    make();
  }
  void make() {
    watch_.emplace(config_).limit_loads({20.0, 15.0});
    watch_->begin(position_rad_, now_ns_);
  }
  Fault judge() { return watch_->judge(motion_, position_rad_, now_ns_ += 1'000'000); }
  /// Periods until the first fault, or 0 if none comes in `limit` of them. `each` is called before every period.
  template <typename Each>
  int periods_until(Fault fault, int limit, Each each) {
    for (int period = 1; period <= limit; ++period) {
      each();
      const Fault found = judge();
      if (found == Fault::kNone) continue;
      EXPECT_EQ(found, fault);
      return period;
    }
    return 0;
  }
  void push(double torque_Nm) {
    motion_.output.torque_Nm = torque_Nm;
    motion_.output.saturated = true;
  }
  JointLoopConfig config_;
  std::optional<MotionWatch> watch_;
  JointStep motion_;
  double position_rad_ = 0.0;
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST_F(MotionWatchTest, ComparesWithTheOrdersAndNotWithThePlanThatBeganAnewWhereTheJointIs) {
  motion_.reference.position_rad = position_rad_;
  motion_.ordered_reference.position_rad = 0.101;
  EXPECT_EQ(judge(), Fault::kFollowingError);
  motion_.ordered_reference.position_rad = 0.099;
  EXPECT_EQ(judge(), Fault::kNone);
}

TEST_F(MotionWatchTest, CallsAJointBlockedThatStandsOrIsPushedBackAtTheTorqueLimit) {
  push(-34.0);
  for (const double each_period_rad : {0.0, 1e-4}) {
    make();
    const auto push_back = [&] { motion_.ordered_reference.position_rad = position_rad_ += each_period_rad; };
    EXPECT_NEAR(periods_until(Fault::kBlocked, 5000, push_back), 500, 1) << each_period_rad;
  }
}

TEST_F(MotionWatchTest, CallsNoJointBlockedThatGetsOnOrWhoseTorqueIsNotAtItsLimit) {
  push(34.0);
  EXPECT_EQ(periods_until(Fault::kNone, 5000,
                          [&] { motion_.ordered_reference.position_rad = position_rad_ += 1.5e-5; }),
            0)
      << "0.015 rad/s";
  motion_.output.saturated = false;
  EXPECT_EQ(periods_until(Fault::kNone, 5000, [] {}), 0);
}

TEST_F(MotionWatchTest, AddsUpWhatIsPushedInVainHoweverItIsInterrupted) {
  int period = 0;
  EXPECT_NEAR(periods_until(Fault::kBlocked, 5000, [&] { push(++period % 400 < 200 ? 34.0 : -34.0); }), 500,
              100)
      << "from either side";
  make();
  EXPECT_NEAR(periods_until(Fault::kBlocked, 5000,
                            [&] {
                              push(34.0);
                              motion_.output.saturated = ++period % 10 != 0;
                            }),
              560, 20)
      << "where readings flicker";
  make();
  EXPECT_NEAR(periods_until(Fault::kBlocked, 5000,
                            [&] {
                              push(34.0);
                              motion_.output.saturated = ++period % 500 < 420;
                              if (period % 500 == 450) watch_->begin(position_rad_, now_ns_);
                            }),
              590, 40)
      << "in bursts, enabled anew between them";
}

TEST_F(MotionWatchTest, ForgetsWhatIsPushedInVainForLessThanATenthOfTheTime) {
  int period = 0;
  EXPECT_EQ(periods_until(Fault::kNone, 100'000,
                          [&] {
                            push(34.0);
                            motion_.output.saturated = ++period % 5000 < 400;
                          }),
            0);
}

TEST_F(MotionWatchTest, CallsNoJointBlockedThatIsHurledToAndFroByAllOfItsTorque) {
  for (const double acceleration_rad_s2 : {5.0, 30.0, 380.0})
    for (const double frequency_Hz : {0.5, 2.0, 8.0}) {
      watch_->begin(position_rad_, now_ns_);
      int period = 0;
      double velocity_rad_s = -0.25 * acceleration_rad_s2 / frequency_Hz;
      EXPECT_EQ(periods_until(Fault::kNone, 20'000,
                              [&] {
                                const bool up = std::fmod(1e-3 * ++period * frequency_Hz, 1.0) < 0.5;
                                push(up ? 34.0 : -34.0);
                                velocity_rad_s +=
                                    std::copysign(1e-3 * acceleration_rad_s2, motion_.output.torque_Nm);
                                position_rad_ += 1e-3 * velocity_rad_s;
                                motion_.ordered_reference.position_rad = position_rad_;
                              }),
                0)
          << acceleration_rad_s2 << " rad/s2, " << frequency_Hz << " Hz";
    }
}

TEST_F(MotionWatchTest, TakesTheTorqueThatASwitchRefusesForNoPush) {
  push(0.0);
  EXPECT_EQ(periods_until(Fault::kNone, 5000, [] {}), 0);
}

TEST_F(MotionWatchTest, BoundsTheLoadOverTime) {
  motion_.load_Nm = 19.9;
  EXPECT_EQ(periods_until(Fault::kNone, 5000, [] {}), 0);
  motion_.load_Nm = -20.1;
  EXPECT_NEAR(periods_until(Fault::kOverload, 5000, [] {}), 20, 1);
}

// One push causes both faults. The distance by which the joint falls behind during the load decides which one comes first.
TEST_F(MotionWatchTest, CallsAPushWhatItIsFirstAndAFollowingErrorWhereItIsBothAtOnce) {
  const auto falls_behind_by = [&](double each_period_rad, Fault fault) {
    watch_->begin(position_rad_ = 0.0, now_ns_);
    motion_.load_Nm = 25.0;
    return periods_until(fault, 5000, [&] { position_rad_ -= each_period_rad; });
  };
  EXPECT_NEAR(falls_behind_by(0.1001 / 19, Fault::kFollowingError), 19, 0);
  EXPECT_NEAR(falls_behind_by(0.1001 / 21, Fault::kFollowingError), 21, 0) << "at once";
  EXPECT_NEAR(falls_behind_by(0.1001 / 22, Fault::kOverload), 21, 0);
}

TEST_F(MotionWatchTest, CallsALoadHighAboveTheNoticeOnly) {
  motion_.load_Nm = -14.9;
  EXPECT_EQ(judge(), Fault::kNone);
  EXPECT_FALSE(watch_->high_load());
  motion_.load_Nm = -15.1;
  EXPECT_EQ(judge(), Fault::kNone);
  EXPECT_TRUE(watch_->high_load());
}

TEST_F(MotionWatchTest, RemembersWhatTheJointCarriedBeforeTheBlow) {
  motion_.load_Nm = 5.0;
  EXPECT_EQ(judge(), Fault::kNone);
  EXPECT_EQ(watch_->usual_load_Nm(), 5.0) << "from the first period on";
  motion_.load_Nm = 25.0;
  for (int k = 0; k < 15; ++k) EXPECT_EQ(judge(), Fault::kNone);
  EXPECT_EQ(watch_->usual_load_Nm(), 5.0);
}

TEST_F(MotionWatchTest, LetsAJointYieldForAWhile) {
  motion_.load_Nm = 25.0;
  motion_.phase = MotionPhase::kYielding;
  EXPECT_NEAR(periods_until(Fault::kOverload, 5000, [] {}), 501, 1);
}

TEST_F(MotionWatchTest, CallsAJointOffTargetThatHasHeldElsewhereForASecond) {
  const auto periods_until_told = [&](bool holding, double distance_rad) {
    for (int period = 1; period <= 5000; ++period)
      if (watch_->off_target(holding, distance_rad, now_ns_ += 1'000'000)) return period;
    return 0;
  };
  EXPECT_EQ(periods_until_told(true, 0.0009), 0) << "within 1 mrad";
  EXPECT_EQ(periods_until_told(false, 0.002), 0) << "on its way";
  EXPECT_EQ(periods_until_told(true, -0.0011), 1000);
  EXPECT_FALSE(watch_->off_target(true, 0.0, now_ns_ += 1'000'000)) << "it came";
  EXPECT_EQ(periods_until_told(true, 0.0011), 1000) << "a second anew";
}

}  // namespace
}  // namespace strainwave
