// After a gap of more than kMaxElapsedPeriods in which the loop did not run a joint comes to rest from where it is and holds.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/flexible_bench.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr int kStall = kMaxElapsedPeriods + 20;
/// A loop that may be away for so long without a fault.
constexpr OverrunLimits kPatient{1000, 1.0, 1.0};

Order sample(const JointBench& bench, double position_rad, double velocity_rad_s, bool begins) {
  Order order;
  order.kind = OrderKind::kSetpoint;
  order.position_rad = position_rad;
  order.velocity_rad_s = velocity_rad_s;
  order.derivatives = 1;
  order.at_cycle = bench.cycle() + 30;
  order.valid_for_s = 1.0;
  order.stream_id = 7;
  order.begins_stream = begins;
  return order;
}

/// Holds, and stands, without a fault.
void expect_held(JointBench& bench) {
  EXPECT_GE(bench.step_until([&] { return bench.mode(0) == Mode::kHolding; }, 500), 0);
  const double position_rad = bench.state(0).joint_position_rad;
  bench.run(0.5);
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  EXPECT_NEAR(bench.state(0).joint_position_rad, position_rad, 1e-3);
}

TEST(StalledLoop, StopsAMoveWhereTheJointIs) {
  for (const bool flexible : {false, true}) {
    JointBench bench({flexible ? flexible_joint() : demo_joint()}, kPatient);
    bench.bring_to_hold(0, flexible ? flexible_table() : demo_table());
    ASSERT_EQ(bench.move(0, 3.0), Reason::kAccepted);
    bench.run(0.3);
    bench.stall(kStall);
    bench.step();
    const double position_rad = bench.state(0).joint_position_rad;
    expect_held(bench);
    EXPECT_LT(bench.state(0).joint_position_rad, position_rad + 0.5) << "it does not go on to 3 rad";
    EXPECT_EQ(bench.move(0, 1.0), Reason::kAccepted) << "a fresh order moves it again";
  }
}

TEST(StalledLoop, EndsAStream) {
  JointBench bench({demo_joint()}, kPatient);
  bench.bring_to_hold(0);
  for (int k = 0; k < 400; ++k) {
    if (k % 10 == 0) {
      ASSERT_TRUE(bench.joint(0).orders().push(sample(bench, 0.5e-3 * (k + 30), 0.5, k == 0)));
    }
    bench.step();
  }
  ASSERT_EQ(bench.mode(0), Mode::kTracking);
  bench.stall(kStall);
  bench.step();
  EXPECT_EQ(bench.order(0, sample(bench, 0.25, 0.5, false)), Reason::kStreamEnded);
  expect_held(bench);
}

TEST(StalledLoop, OfUpToTwentyPeriodsIsCaughtUpWith) {
  JointBench bench({demo_joint()}, kPatient);
  bench.bring_to_hold(0);
  ASSERT_EQ(bench.move(0, 1.0), Reason::kAccepted);
  bench.run(0.3);
  bench.stall(kMaxElapsedPeriods - 1);
  bench.run(2.0);
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  EXPECT_NEAR(bench.state(0).joint_position_rad, 1.0, 1e-3);
}

}  // namespace
}  // namespace strainwave::testing
