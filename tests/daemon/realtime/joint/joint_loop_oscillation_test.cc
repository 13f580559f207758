// SPDX-License-Identifier: BSD-3-Clause
// Joints that differ from their configuration and oscillate. Fault 26 comes soon, and its text names the cause. Virtual time.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>

#include "lcmtypes/reading_doubt.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

/// Moves to and fro by 0.3 rad, once per second, until it faults. Returns the fault's text.
std::string words_of_fault(BenchJoint joint, const GainTable& table) {
  joint.loop.limits.overspeed_rad_s = 1e3;
  joint.loop.limits.following_error_rad = 10.0;
  JointBench bench({joint});
  bench.bring_to_hold(0, table);
  for (int move = 0; move < 10 && bench.fault(0) == Fault::kNone; ++move) {
    (void)bench.move(0, move % 2 == 0 ? 0.3 : 0.0);
    (void)bench.step_until([&] { return bench.fault(0) != Fault::kNone; }, 1000);
  }
  if (bench.fault(0) != Fault::kNone) {
    EXPECT_EQ(bench.state(0).torque_commanded_Nm, 0.0);
  }
  const std::string words = fault_words(bench.fault(0), bench.state(0).drive_error);
  std::printf("%s\n", words.c_str());
  return words;
}

TEST(JointLoopOscillation, IsStoppedAndSaysWhatWasSeenWhereTheDelayIsLonger) {
  BenchJoint joint = flexible_joint();
  joint.drive.plant.delay.periods += 3.0;
  const std::string words = words_of_fault(joint, flexible_table());
  EXPECT_EQ(words.find("torque oscillation: the torque reversed "), 0U);
  EXPECT_NE(words.find("check delay_periods"), std::string::npos);
}

TEST(JointLoopOscillation, IsStoppedWhereTheMotorIsLighterAndTheDelayLonger) {
  BenchJoint joint = flexible_joint();
  joint.drive.plant.joint.inertia_kgm2 *= 0.3;
  joint.drive.plant.delay.periods += 1.0;
  const std::string words = words_of_fault(joint, flexible_table());
  EXPECT_EQ(words.find("torque oscillation: the torque reversed "), 0U);
}

TEST(JointLoopOscillation, DoesNotOccurInAJointAsConfigured) {
  EXPECT_EQ(words_of_fault(flexible_joint(), flexible_table()), "none");
}

}  // namespace
}  // namespace strainwave::testing
