// A table that declares more friction than the joint has, in the daemon's loop: certified, since friction is no part of the proof.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "control/gain_table.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

/// The shipped table with this friction in every rule.
GainTable table_with(double static_Nm, double coulomb_Nm) {
  GainTable table = demo_table();
  for (int i = 0; i < table.friction.rule_count; ++i) {
    FrictionParameters& friction = table.friction.rules[static_cast<std::size_t>(i)].friction;
    friction.static_Nm = static_Nm;
    friction.coulomb_Nm = coulomb_Nm;
  }
  return table;
}

BenchJoint joint_declared(bool rigid) {
  BenchJoint joint = demo_joint();
  joint.loop.controller.rigid = rigid;
  joint.loop.controller.use_observer = rigid;
  joint.loop.controller.use_landing = rigid;
  return joint;
}

struct Seen {
  int last_reversals = 0;        ///< of a torque of more than the joint's own friction, in the last second
  double last_travel_rad = 0.0;  ///< peak to peak in the last half second
  double notice_s = -1.0;
  double fault_s = -1.0;
  Fault fault = Fault::kNone;
};

Seen watch(bool rigid, const GainTable& table, double target_rad, double duration_s) {
  JointBench bench({joint_declared(rigid)});
  bench.bring_to_hold(0, table);
  EXPECT_EQ(bench.move(0, target_rad), Reason::kAccepted);
  Seen seen;
  double side = 0.0;
  double lowest_rad = 1e9;
  double highest_rad = -1e9;
  const int periods = static_cast<int>(duration_s * 1e3);
  for (int k = 0; k < periods; ++k) {
    bench.step();
    const state_v1& state = bench.state(0);
    if (seen.notice_s < 0.0 && bench.has_notice(0, Notice::kPlainLaw)) seen.notice_s = 1e-3 * k;
    if (seen.fault_s < 0.0 && bench.mode(0) == Mode::kFaulted) {
      seen.fault_s = 1e-3 * k;
      seen.fault = bench.fault(0);
    }
    const double torque_Nm = bench.drive(0).command().torque_Nm;
    if (std::abs(torque_Nm) > 2.0) {
      if (k >= periods - 1000 && side * torque_Nm < 0.0) ++seen.last_reversals;
      side = torque_Nm;
    }
    if (k < periods - 500) continue;
    lowest_rad = std::min(lowest_rad, state.joint_position_rad);
    highest_rad = std::max(highest_rad, state.joint_position_rad);
  }
  seen.last_travel_rad = highest_rad - lowest_rad;
  return seen;
}

TEST(JointLoopFriction, AJointOfWhichTooMuchIsDeclaredDoesNotShakeForEver) {
  for (const bool rigid : {false, true})
    for (const auto& [static_Nm, coulomb_Nm] : {std::pair{8.0, 7.0}, {10.0, 5.0}, {15.0, 15.0}, {17.0, 17.0}})
      for (const double target_rad : {0.001, 0.01, 0.1, 1.0}) {
        const GainTable table = table_with(static_Nm, coulomb_Nm);
        ASSERT_FALSE(find_defect(table)) << *find_defect(table);
        const Seen seen = watch(rigid, table, target_rad, 8.0);
        EXPECT_EQ(seen.last_reversals, 0)
            << (rigid ? "rigid" : "on a spring") << ", " << static_Nm << "/" << coulomb_Nm << ", to "
            << target_rad << ": notice at " << seen.notice_s << " s, fault " << static_cast<int>(seen.fault)
            << " at " << seen.fault_s << " s, travel " << seen.last_travel_rad << " rad";
        EXPECT_TRUE(rigid || seen.notice_s >= 0.0) << static_Nm << "/" << coulomb_Nm << ", to " << target_rad;
      }
}

// Of the catalogue's joints more than twice is refused (table_admission.h); where it comes through, the joint may lose its default law.
TEST(JointLoopFriction, UpToTwiceItsOwnIsNoChatterAndThreeTimesDoesNotShakeForEver) {
  for (const bool rigid : {false, true})
    for (const auto& [static_Nm, coulomb_Nm] : {std::pair{1.3, 0.5}, {3.0, 2.0}, {5.0, 4.0}})
      for (const double target_rad : {0.001, 0.01, 0.1, 1.0}) {
        const Seen seen = watch(rigid, table_with(static_Nm, coulomb_Nm), target_rad, 8.0);
        EXPECT_TRUE(seen.notice_s < 0.0 || static_Nm > 3.0)
            << rigid << ", " << static_Nm << "/" << coulomb_Nm << ", " << target_rad;
        EXPECT_EQ(seen.last_reversals, 0) << rigid << ", " << static_Nm << "/" << coulomb_Nm;
        EXPECT_EQ(seen.fault, Fault::kNone) << rigid << ", " << static_Nm << "/" << coulomb_Nm;
      }
}

}  // namespace
}  // namespace strainwave::testing
