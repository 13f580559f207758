// SPDX-License-Identifier: BSD-3-Clause
// A joint that holds elsewhere than it was sent, in the daemon's loop: what keeps it there, and that it is said. The joint is not
// declared rigid and told of no spring, so that nothing but the law's feedback brings it back.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kTarget_rad = 0.1;
constexpr double kTolerance_rad = 1e-3;

BenchJoint plain_joint() {
  BenchJoint joint = demo_joint();
  joint.loop.rest_tolerance_rad = kTolerance_rad;
  return joint;
}

/// Without learning, which would take the load over.
void bring_to_rest(JointBench& bench) {
  ASSERT_EQ(bench.order(0, OrderKind::kFreezeLearning), Reason::kAccepted);
  bench.bring_to_hold(0);
  ASSERT_EQ(bench.move(0, kTarget_rad), Reason::kAccepted);
  ASSERT_GE(bench.step_until([&] { return bench.mode(0) == Mode::kHolding; }, 1000), 0);
}
double off_rad(const JointBench& bench) {
  return std::abs(bench.state(0).joint_position_rad - kTarget_rad);
}
bool told(const JointBench& bench) {
  return bench.has_notice(0, Notice::kOffTarget);
}
/// Periods until it is told, while each of them is held against the tolerance: so many of the last ones were off the place.
int periods_off_when_told(JointBench& bench, int limit) {
  int off = 0;
  for (int k = 0; k < limit; ++k) {
    bench.step();
    off = bench.mode(0) == Mode::kHolding && off_rad(bench) > kTolerance_rad ? off + 1 : 0;
    if (told(bench)) return off;
  }
  return 0;
}

TEST(JointLoopOffTarget, ALoadThatFeedbackCarriesMilliradiansOffIsToldAfterASecondAndIsNoFault) {
  JointBench bench({plain_joint()});
  bring_to_rest(bench);
  bench.run(1.5);
  ASSERT_FALSE(told(bench));
  bench.drive(0).simulated().set_load_torque_Nm(10.0);
  EXPECT_NEAR(periods_off_when_told(bench, 3000), 1000, 1);
  EXPECT_GT(off_rad(bench), 2e-3);
  EXPECT_EQ(bench.mode(0), Mode::kHolding);
  bench.drive(0).simulated().set_load_torque_Nm(0.0);
  ASSERT_EQ(bench.move(0, kTarget_rad + 0.1), Reason::kAccepted);
  bench.step_until([&] { return bench.mode(0) == Mode::kHolding; }, 1000);
  EXPECT_FALSE(told(bench)) << "a second anew";
}

}  // namespace
}  // namespace strainwave::testing
