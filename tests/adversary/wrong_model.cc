// SPDX-License-Identifier: BSD-3-Clause
// The gain table or the configuration describes the joint wrongly. The joint holds and makes a small and a large move. Its torque must stop reversing
// soon after the first motion. Virtual time.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kCounted_rad = 40e-6;  // two counts of the motor's encoder
constexpr double kReversal_Nm = 4.0;    // more than the friction compensation of the control law

/// The demo's joint at 5 rad/s and 60 rad/s^2, with a following error limit that never trips.
BenchJoint patient_joint() {
  BenchJoint joint = demo_joint();
  joint.drive.ambient = TemperatureProfile::constant(20.0);
  joint.loop.controller.motion = {5.0, 60.0, 60.0};
  joint.loop.move_speed_share = 1.0;
  joint.loop.limits.following_error_rad = 10.0;
  joint.loop.limits.overspeed_rad_s = 1000.0;
  return joint;
}

/// Steps for `periods`. The torque may reverse for two seconds after the first motion. If the motion lasts longer, it may also reverse once where the
/// braking begins and once at the stop.
void expect_quiet(JointBench& bench, int periods, const ::testing::Message& what) {
  constexpr int kQuietAfter = 2000;  // periods
  const double begin_rad = bench.state(0).joint_position_rad;
  int first_motion = -1;
  int late = 0;
  bool still_moves = false;  // ordered to move at the end of those two seconds
  double side = 0.0;
  for (int k = 0; k < periods; ++k) {
    bench.step();
    const state_v1& state = bench.state(0);
    if (first_motion < 0 && std::abs(state.joint_position_rad - begin_rad) > kCounted_rad) first_motion = k;
    const bool over = first_motion >= 0 && k > first_motion + kQuietAfter;
    still_moves = still_moves || (over && state.setpoint_velocity_rad_s != 0.0);
    if (std::abs(state.torque_commanded_Nm) <= kReversal_Nm) continue;
    late += over && side * state.torque_commanded_Nm < 0.0 ? 1 : 0;
    side = state.torque_commanded_Nm;
  }
  EXPECT_LE(late, still_moves ? 2 : 0) << what;
}

void expect_quiet_soon(const BenchJoint& joint, const GainTable& table) {
  for (const double step_rad : {0.01, 1.0}) {
    JointBench bench({joint});
    bench.bring_to_hold(0, table);
    expect_quiet(bench, 3000, ::testing::Message() << "held");
    if (bench.mode(0) == Mode::kFaulted) continue;
    ASSERT_EQ(bench.move(0, step_rad), Reason::kAccepted);
    expect_quiet(bench, 3000, ::testing::Message() << "moved by " << step_rad << " rad");
    if (bench.mode(0) != Mode::kFaulted) {
      EXPECT_NEAR(bench.state(0).target_position_rad, step_rad, 1e-12);
    }
  }
}

TEST(WrongModel, EndsReversalsSoonWhenTheTableIsForTenTimesTheInertia) {
  BenchJoint joint = patient_joint();
  joint.drive.plant.joint.inertia_kgm2 = 0.1089;
  expect_quiet_soon(joint, read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/total-1.089/c4.json"));
}

TEST(WrongModel, EndsReversalsSoonWhenTheDelayIsTwoAndItIsToldOne) {
  BenchJoint joint = patient_joint();
  joint.loop.controller.delay_periods = 1;
  joint.drive.plant.delay.periods = 2.0;
  expect_quiet_soon(joint, demo_table());
}

TEST(WrongModel, EndsReversalsSoonWhenTheEncoderIsTheLinksAndItIsToldTheMotors) {
  BenchJoint joint = patient_joint();
  put_on_spring(joint, flexible_plant());
  joint.drive.plant.effects.transmission->damping_Nms_rad = 1.0;
  joint.drive.plant.link_encoder = joint.drive.plant.encoder;
  joint.drive.plant.feedback = EncoderSide::kLink;
  expect_quiet_soon(joint, flexible_table());
}

}  // namespace
}  // namespace strainwave::testing
