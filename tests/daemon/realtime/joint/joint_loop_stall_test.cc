// SPDX-License-Identifier: BSD-3-Clause
// After a gap of more than kMaxElapsedPeriods in which the loop did not run a joint goes on with its stream. Moves: tests/adversary/stalled_loop.cc.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr int kStall = kMaxElapsedPeriods + 20;
/// A loop that may be away for so long without a fault.
constexpr OverrunLimits kPatient{1.0, 1.0};

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

TEST(StalledLoop, GoesOnWithAStreamAtItsTimes) {
  JointBench bench({demo_joint()}, kPatient);
  bench.bring_to_hold(0);
  const auto ride = [&](int from, int to) {
    for (int k = from; k < to; ++k) {
      if (k % 10 == 0) {
        ASSERT_TRUE(bench.joint(0).orders().push(sample(bench, 0.5e-3 * (k + 30), 0.5, k == 0)));
      }
      bench.step();
    }
  };
  ride(0, 400);
  bench.stall(kStall);
  bench.step();
  ride(400 + kStall + 1, 1000);
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  EXPECT_EQ(bench.mode(0), Mode::kTracking);
  EXPECT_NEAR(bench.state(0).joint_position_rad, 0.5e-3 * 999, 5e-3);
}

}  // namespace
}  // namespace strainwave::testing
