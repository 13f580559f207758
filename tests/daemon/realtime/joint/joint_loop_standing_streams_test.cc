// SPDX-License-Identifier: BSD-3-Clause
// Streams that stand still, or end at a position, as real senders send them: positions read from an encoder that
// flickers, and a new stream with every sample. A joint at rest needs no torque except for its load. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "sim/joint/reference_plant.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

enum class Kind { kRigid, kSpring };
constexpr const char* kNames[]{"rigid", "flexible"};

BenchJoint joint_of(Kind kind, double ambient_C) {
  BenchJoint joint = demo_joint();
  if (kind != Kind::kRigid) put_on_spring(joint, flexible_plant());
  joint.drive.ambient = TemperatureProfile::constant(ambient_C);
  return joint;
}

const GainTable& table_of(Kind kind) {
  return kind == Kind::kRigid ? demo_table() : flexible_table();
}

/// Streams to the joint every 10 ms for 2 s. Returns the largest change of torque between two periods in the last 1.5 s.
double largest_step_Nm(JointBench& bench, double flicker_rad) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> flicker(-flicker_rad, flicker_rad);
  const double place_rad = bench.state(0).joint_position_rad;
  double last_Nm = 0.0;
  double largest_Nm = 0.0;
  for (int k = 0; k < 2000; ++k) {
    if (k % 10 == 0) {
      Order order{.kind = OrderKind::kSetpoint, .position_rad = place_rad + flicker(random)};
      order.valid_for_s = 0.1;
      order.stream_id = 1;
      order.begins_stream = k == 0;
      order.sent_us = bench.sent_us();
      EXPECT_TRUE(bench.joint(0).orders().push(order));
    }
    bench.step();
    const double torque_Nm = bench.state(0).torque_commanded_Nm;
    if (k > 500) largest_Nm = std::max(largest_Nm, std::abs(torque_Nm - last_Nm));
    last_Nm = torque_Nm;
  }
  EXPECT_EQ(bench.fault(0), Fault::kNone);
  return largest_Nm;
}

// By the sign of the setpoint's velocity, all of friction used to alternate at nanoradians: 3.6 N.m at 20 degC, 7.5 at -8 degC.
TEST(StandingStream, ThatFlickersByUpToHalfACountDoesNotThrowFrictionToAndFro) {
  for (const Kind kind : {Kind::kRigid, Kind::kSpring})
    for (const double ambient_C : {-8.0, 20.0})
      for (const double flicker_rad : {0.0, 1e-9, 1e-7, 1e-6, 1e-5}) {
        JointBench bench({joint_of(kind, ambient_C)});
        bench.bring_to_hold(0, table_of(kind));
        const double step_Nm = largest_step_Nm(bench, flicker_rad);
        // The link's motion needs an additional torque of the motor.
        EXPECT_LT(step_Nm, kind == Kind::kSpring ? 1.5 : 1.0)
            << kNames[static_cast<int>(kind)] << ", " << ambient_C << " degC, " << flicker_rad << " rad";
      }
}

// A poor sender begins a new stream with every sample. The joint must not oscillate. At the end, its setpoint
// used to reverse in every period, by 13 N.m and more, until the sensor was taken for stuck (49 of 168).
TEST(StandingStream, EndsQuietlyWhereEverySampleBeginsOneWhateverFrictionAndLoadAre) {
  for (const double friction : {0.6, 1.0, 1.7})
    for (const double load_Nm : {0.0, 8.0, 12.0})
      for (const double end_rad : {1.0, 0.3}) {
        BenchJoint joint = demo_joint_with_friction(friction);
        joint.loop.limits.following_error_rad = 0.2;
        JointBench bench({joint});
        bench.bring_to_hold(0);
        bench.drive(0).simulated().set_load_torque_Nm(load_Nm);
        bench.run(1.0);
        const double begin_rad = bench.state(0).joint_position_rad;
        for (int sent = 0; sent < 300 && bench.fault(0) == Fault::kNone; ++sent) {
          (void)bench.move(0, std::min(end_rad, begin_rad + 0.01 * sent), 0.05);
          bench.run(0.009);
        }
        EXPECT_EQ(bench.fault(0), Fault::kNone) << friction << ", " << load_Nm << ", " << end_rad;
        EXPECT_NEAR(bench.state(0).joint_position_rad, end_rad, 0.01) << friction << ", " << load_Nm;
      }
}

// The load that the stream announced ends with the stream. The torque that held against it is not forgotten, so that the joint stays in place.
TEST(StandingStream, ThatToldOfALoadThatIsNoneLeaveNothingOfItForTheNextEnable) {
  for (const bool flexible : {false, true})
    for (const double configured_Nm : {8.0, 12.0, -12.0}) {
      JointBench bench({flexible ? flexible_joint() : demo_joint()});
      bench.bring_to_hold(0, flexible ? flexible_table() : demo_table());
      for (int k = 0; k < 1000; ++k) {
        if (k % 10 == 0) {
          Order order{.kind = OrderKind::kSetpoint};
          order.valid_for_s = 0.1;
          order.stream_id = 1;
          order.begins_stream = k == 0;
          order.sent_us = bench.sent_us();
          order.derivatives = 1;
          order.torque_Nm = configured_Nm * std::min(1.0, k / 500.0);
          ASSERT_TRUE(bench.joint(0).orders().push(order));
        }
        bench.step();
      }
      bench.run(0.5);
      ASSERT_EQ(bench.order(0, OrderKind::kDisable), Reason::kAccepted);
      bench.run(2.0);
      const double stood_rad = bench.state(0).joint_position_rad;
      ASSERT_EQ(bench.order(0, OrderKind::kEnable), Reason::kAccepted);
      double moved_rad = 0.0;
      for (int k = 0; k < 1500; ++k) {
        bench.step();
        moved_rad = std::max(moved_rad, std::abs(bench.state(0).joint_position_rad - stood_rad));
      }
      double left_rad = 0.0;
      for (const double target_rad : {0.5, 0.0}) {
        ASSERT_EQ(bench.move(0, target_rad), Reason::kAccepted);
        bench.run(1.5);
        left_rad = std::max(left_rad, std::abs(bench.state(0).joint_position_rad - target_rad));
      }
      EXPECT_LT(moved_rad, 1e-4);
      EXPECT_LT(left_rad, 1.2e-3);
    }
}

}  // namespace
}  // namespace strainwave::testing
