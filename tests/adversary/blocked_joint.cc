// SPDX-License-Identifier: BSD-3-Clause
// A joint that cannot move and a client that keeps ordering it to move. The joint must not push for ever. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

/// Friction of about 200 N.m, more than the motor can overcome.
BenchJoint jammed_joint() {
  return demo_joint_with_friction(50.0);
}

struct Stream {
  double begin_rad = 0.0;
  double speed_rad_s = 0.0;  ///< 0: every setpoint is end_rad
  double end_rad = 1.0;
};

class BlockedJoint : public ::testing::Test {
 protected:
  /// Sends a setpoint every 10 ms for `duration_s`, or until the joint faults. Returns the seconds that it took.
  double stream(JointBench& bench, const Stream& stream, double duration_s) {
    for (int sent = 0; sent < static_cast<int>(duration_s * 100.0); ++sent) {
      const double way_rad = stream.speed_rad_s * 0.01 * sent;
      const double target_rad =
          stream.speed_rad_s > 0.0 ? std::min(stream.end_rad, stream.begin_rad + way_rad) : stream.end_rad;
      if (bench.fault(0) != Fault::kNone) return 0.01 * sent;
      (void)bench.move(0, target_rad, 0.05);
      bench.run(0.009);
    }
    return duration_s;
  }
  /// Adds sensor noise, so that the daemon does not report a stuck sensor, which is another fault.
  static void let_counts_flicker(JointBench& bench) {
    ASSERT_EQ(bench.inject(0, {InjectedFault::kSensorNoisy, 0.0, 0.0, 2e-5}), Reason::kAccepted);
  }
  static bool is_expected(Fault fault) {
    constexpr std::array kExpected{Fault::kFollowingError, Fault::kBlocked};
    return std::find(kExpected.begin(), kExpected.end(), fault) != kExpected.end();
  }
};

TEST_F(BlockedJoint, FaultsWithinASecondHoweverItIsStreamedTo) {
  for (const Stream& form : {Stream{0.0, 0.0, 1.0}, Stream{0.0, 1.0, 1.0}, Stream{0.0, 0.0, -0.15}}) {
    JointBench bench({jammed_joint()});
    bench.bring_to_hold(0);
    let_counts_flicker(bench);
    bench.run(0.3);
    const double took_s = stream(bench, form, 20.0);
    EXPECT_LT(took_s, 1.0) << form.end_rad << " at " << form.speed_rad_s;
    EXPECT_TRUE(is_expected(bench.fault(0))) << to_text(bench.fault(0));
    EXPECT_FALSE(bench.drive(0).command().enable);
  }
}

TEST_F(BlockedJoint, FaultsByItsTorqueWhereNoFollowingErrorIsLargeEnough) {
  BenchJoint joint = jammed_joint();
  joint.loop.limits.following_error_rad = 10.0;
  joint.loop.limits.load.load_Nm = 1e3;  // the load check would end the motion sooner
  JointBench bench({joint});
  bench.bring_to_hold(0);
  let_counts_flicker(bench);
  bench.run(0.3);
  EXPECT_LT(stream(bench, {0.0, 0.0, 1.0}, 20.0), 1.5);
  EXPECT_TRUE(is_expected(bench.fault(0))) << to_text(bench.fault(0));
}

TEST_F(BlockedJoint, FaultsAfterASingleMove) {
  JointBench bench({jammed_joint()});
  bench.bring_to_hold(0);
  ASSERT_EQ(bench.move(0, 1.0), Reason::kAccepted);
  EXPECT_GE(bench.step_until([&] { return bench.fault(0) != Fault::kNone; }, 1000), 0);
}

TEST_F(BlockedJoint, FaultsHoweverTheOrdersToPushAreInterrupted) {
  enum class Between { kMoveBack, kHold, kEnable };
  for (const Between between : {Between::kMoveBack, Between::kHold, Between::kEnable}) {
    BenchJoint joint = jammed_joint();
    joint.loop.limits.following_error_rad = 10.0;
    joint.loop.limits.load.load_Nm = 1e3;
    JointBench bench({joint});
    bench.bring_to_hold(0);
    let_counts_flicker(bench);
    bench.run(0.3);
    int bursts = 0;
    for (; bursts < 20 && bench.fault(0) == Fault::kNone; ++bursts) {
      (void)bench.move(0, 1.0);
      bench.run(0.42);
      if (between == Between::kMoveBack) (void)bench.move(0, bench.state(0).joint_position_rad - 1e-3);
      if (between == Between::kHold) (void)bench.order(0, OrderKind::kHold);
      if (between == Between::kEnable) {
        (void)bench.order(0, OrderKind::kDisable);
        bench.run(0.2);
        (void)bench.order(0, OrderKind::kEnable);
      }
      bench.run(0.08);
    }
    EXPECT_LE(bursts, 3) << static_cast<int>(between);
    EXPECT_EQ(bench.fault(0), Fault::kBlocked) << to_text(bench.fault(0));
  }
}

TEST_F(BlockedJoint, IsNotWhatAHeavyLoadedOrAStiffJointIs) {
  BenchJoint loaded = demo_joint();
  loaded.loop.limits.following_error_rad = 0.2;
  for (BenchJoint joint : {loaded, demo_joint_with_friction(1.5)}) {
    JointBench bench({joint});
    bench.bring_to_hold(0);
    bench.drive(0).simulated().set_load_torque_Nm(8.0);
    bench.run(1.0);
    EXPECT_EQ(stream(bench, {bench.state(0).joint_position_rad, 1.0, 1.0}, 3.0), 3.0)
        << to_text(bench.fault(0));
    EXPECT_NEAR(bench.state(0).joint_position_rad, 1.0, 0.01);
  }
}

}  // namespace
}  // namespace strainwave::testing
