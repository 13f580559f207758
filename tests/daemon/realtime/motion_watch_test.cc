#include "daemon/realtime/motion_watch.h"

#include <gtest/gtest.h>

namespace strainwave {
namespace {

class MotionWatchTest : public ::testing::Test {
 protected:
  MotionWatchTest() : watch_({0.1, 20.0, 0.5, 0.01}) { watch_.begin(now_ns_); }
  Fault judge() { return watch_.judge(motion_, position_rad_, now_ns_ += 1'000'000); }
  /// Periods until the first fault, 0 when none comes in `limit` of them; `each` changes things before.
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
  MotionWatch watch_;
  JointStep motion_;
  double position_rad_ = 0.0;
  std::int64_t now_ns_ = 1'000'000'000;
};

TEST_F(MotionWatchTest, HasNothingAgainstAJointThatDoesWhatItIsOrdered) {
  EXPECT_EQ(periods_until(Fault::kNone, 5000,
                          [&] { motion_.ordered_reference.position_rad = position_rad_ += 0.001; }),
            0);
}

TEST_F(MotionWatchTest, ComparesWithTheOrdersAndNotWithThePlanThatBeganAnewWhereTheJointIs) {
  motion_.reference.position_rad = position_rad_;
  motion_.ordered_reference.position_rad = 0.101;
  EXPECT_EQ(judge(), Fault::kFollowingError);
  motion_.ordered_reference.position_rad = 0.099;
  EXPECT_EQ(judge(), Fault::kNone);
}

TEST_F(MotionWatchTest, CallsAJointBlockedThatStandsAtTheTorqueLimit) {
  push(34.0);
  EXPECT_NEAR(periods_until(Fault::kBlocked, 5000, [] {}), 500, 1);
}

TEST_F(MotionWatchTest, CallsAJointBlockedThatIsPushedBackAtTheTorqueLimit) {
  push(-34.0);
  EXPECT_NEAR(periods_until(Fault::kBlocked, 5000,
                            [&] {
                              position_rad_ += 1e-4;
                              motion_.ordered_reference.position_rad = position_rad_;
                            }),
              500, 1);
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

TEST_F(MotionWatchTest, CountsAnewWhenTheTorqueTurnsRoundOrLeavesItsLimit) {
  int period = 0;
  EXPECT_EQ(periods_until(Fault::kNone, 5000, [&] { push(++period % 400 < 200 ? 34.0 : -34.0); }), 0);
  EXPECT_EQ(periods_until(Fault::kNone, 5000,
                          [&] {
                            push(34.0);
                            motion_.output.saturated = ++period % 400 != 0;
                          }),
            0);
}

TEST_F(MotionWatchTest, TakesTheTorqueThatASwitchRefusesForNoPush) {
  push(0.0);
  EXPECT_EQ(periods_until(Fault::kNone, 5000, [] {}), 0);
}

TEST_F(MotionWatchTest, CountsNewPlansByTheSecondWhateverBeginsMeanwhile) {
  EXPECT_NEAR(periods_until(Fault::kBlocked, 5000, [&] { ++motion_.replans; }), 51, 1);
  watch_.begin(now_ns_);
  motion_.replans = 0;
  int period = 0;
  EXPECT_EQ(periods_until(Fault::kNone, 20000, [&] { motion_.replans = ++period / 25; }), 0) << "40 a second";
}

TEST_F(MotionWatchTest, BoundsTheEstimatedLoadOverTime) {
  motion_.estimate.disturbance.load_Nm = 19.9;
  EXPECT_EQ(periods_until(Fault::kNone, 5000, [] {}), 0);
  motion_.estimate.disturbance.load_Nm = -20.1;
  EXPECT_NEAR(periods_until(Fault::kOverload, 5000, [] {}), 500, 1);
}

TEST_F(MotionWatchTest, RemembersNothingOnceItBeginsAnew) {
  push(34.0);
  EXPECT_EQ(periods_until(Fault::kNone, 5000,
                          [&, period = 0]() mutable {
                            if (++period % 400 == 0) watch_.begin(now_ns_);
                          }),
            0);
}

}  // namespace
}  // namespace strainwave
