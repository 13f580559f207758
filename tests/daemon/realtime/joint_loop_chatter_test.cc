// A joint that chatters, in the daemon's loop: said, fallen back, and ended by a fault if it goes on.
#include <gtest/gtest.h>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

/// A drive so late that no gain of the table is stable, and a configuration that does not know it.
BenchJoint late_joint() {
  BenchJoint joint = demo_joint();
  joint.drive.plant.delay.periods = 10.0;
  return joint;
}

TEST(JointLoopChatter, IsSaidAndEndsInItsFaultWithinHalfASecond) {
  JointBench bench({late_joint()});
  bench.bring_to_hold(0);
  ASSERT_EQ(bench.move(0, 0.02), Reason::kAccepted);
  ASSERT_GE(bench.step_until([&] { return bench.has_notice(0, Notice::kPlainLaw); }, 1000), 0);
  EXPECT_NE(bench.mode(0), Mode::kFaulted);
  ASSERT_GE(bench.step_until([&] { return bench.mode(0) == Mode::kFaulted; }, 500), 0);
  EXPECT_EQ(bench.fault(0), Fault::kChatter);
}

TEST(JointLoopChatter, IsNotSaidOfTheSoundJoint) {
  JointBench bench({demo_joint()});
  bench.bring_to_hold(0);
  for (const double target_rad : {0.001, 0.5, -1.0, -0.999}) {
    ASSERT_EQ(bench.move(0, target_rad), Reason::kAccepted);
    for (int k = 0; k < 1500; ++k) {
      bench.step();
      ASSERT_FALSE(bench.has_notice(0, Notice::kPlainLaw)) << target_rad << ", " << k;
    }
  }
}

}  // namespace
}  // namespace strainwave::testing
