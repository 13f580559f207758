// SPDX-License-Identifier: BSD-3-Clause
// A joint whose drive closes its own loop, from the loop's orders to the simulated drive's cascade and back. Virtual time.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "base/units.h"
#include "tests/drivers/can/drive_bench.h"
#include "tests/support/flexible_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kInitial_rad = 0.3;
constexpr double kCount_rad = kTurn_rad / 320000;

struct OwnLoopJoint {
  BenchJoint joint = demo_joint();
  BenchDrive drive = bench_drive(3);
};

OwnLoopJoint joint_in(DriveMode mode) {
  OwnLoopJoint made;
  made.drive.config.drive_mode = mode;
  made.drive.config.torque_limit_Nm = kReferencePeakTorque_Nm;
  made.drive.config.units.velocity_rad_s_per_unit = kCount_rad;
  made.drive.node.drive.has_csp = made.drive.node.drive.has_csv = true;
  made.drive.node.drive.plant.initial_position_rad = kInitial_rad;
  JointControllerConfig& controller = made.joint.loop.controller;
  controller.drive_mode = mode;
  controller.encoder_resolution_rad = kCount_rad;
  controller.delay_periods = 1;
  return made;
}

/// The loop, the bus and the drive.
class OwnLoopBench {
 public:
  explicit OwnLoopBench(const OwnLoopJoint& made, const GainTable& table = demo_table()) : can({made.drive}) {
    can.bus_config().load_limit = 1.0;
    can.start();
    loop = std::make_unique<JointLoop>(0, made.joint.loop, can.bus().make_actuator(0), *replies_, *events_);
    time_.now_ns = can.can().now_ns();
    loop->table_slot(0) = {table, 1, 1};
    give({.kind = OrderKind::kUseTable});
    for (int i = 0; i < 100; ++i) step();
    give({.kind = OrderKind::kEnable});
    EXPECT_TRUE(run_until(Mode::kHolding, 1000));
  }
  /// Steps to `periods` later. The periods in between are skipped.
  void step(int periods = 1) {
    time_.elapsed_periods = periods;
    time_.cycle += periods;
    time_.now_ns += periods * DriveBench::kPeriod_ns;
    can.can().run_to(time_.now_ns);
    can.bus().begin_cycle(time_.now_ns);
    loop->step(time_);
    can.bus().end_cycle();
    const double off_rad = motion().ordered_reference.position_rad - loop->joint().drive.position_rad();
    if (loop->joint().mode.controlled()) largest_off_rad = std::max(largest_off_rad, std::abs(off_rad));
  }
  void give(const Order& order) {
    Order numbered = order;
    numbered.id = ++orders_;
    ASSERT_TRUE(loop->orders().push(numbered));
    step();
    Reply reply;
    while (replies_->pop(reply)) EXPECT_EQ(reply.reason, Reason::kAccepted) << static_cast<int>(order.kind);
  }
  bool run_until(Mode mode, int limit) {
    for (int i = 0; i < limit && loop->mode() != mode; ++i) step();
    return loop->mode() == mode;
  }
  void move(double position_rad) {
    give({.kind = OrderKind::kSetpoint, .position_rad = position_rad, .approaches = true});
    EXPECT_TRUE(run_until(Mode::kHolding, 3000)) << to_text(fault());
    for (int i = 0; i < 500; ++i) step();
  }
  Reason last_reason() {
    Reply reply;
    while (replies_->pop(reply)) {
    }
    return reply.reason;
  }
  const JointStep& motion() const { return loop->joint().law.motion(); }
  Fault fault() const { return static_cast<Fault>(loop->record().state.fault); }
  double position_rad() { return can.node().drive().plant().state().position_rad; }

  DriveBench can;
  std::unique_ptr<JointLoop> loop;
  double largest_off_rad = 0.0;  ///< from the setpoint, under control

 private:
  std::unique_ptr<ReplyQueue> replies_ = std::make_unique<ReplyQueue>();
  std::unique_ptr<EventQueue> events_ = std::make_unique<EventQueue>();
  CycleTime time_;
  std::int64_t orders_ = 0;
};

class OwnLoopInEachMode : public ::testing::TestWithParam<DriveMode> {};

TEST_P(OwnLoopInEachMode, StandsWhereItIsWhenItIsEnabledAndArrivesWhereItIsSent) {
  OwnLoopBench bench(joint_in(GetParam()));
  EXPECT_NEAR(bench.position_rad(), kInitial_rad, 2.0 * kCount_rad);
  for (const double target_rad : {1.3, -0.2, -0.19, 0.3}) {
    bench.move(target_rad);
    EXPECT_NEAR(bench.position_rad(), target_rad, 5.0 * kCount_rad);
  }
  EXPECT_EQ(bench.fault(), Fault::kNone);
  EXPECT_LT(bench.largest_off_rad, 0.02) << "at up to 6 rad/s, where a period is 6 mrad";
}

TEST_P(OwnLoopInEachMode, ComesToRestWhenItIsDisabledAndStopsOnTheDrivesRampAtAFault) {
  OwnLoopBench bench(joint_in(GetParam()));
  bench.give({.kind = OrderKind::kSetpoint, .position_rad = 2.0, .approaches = true});
  for (int i = 0; i < 150; ++i) bench.step();
  bench.give({.kind = OrderKind::kDisable});
  EXPECT_TRUE(bench.run_until(Mode::kOff, 2000));
  for (int i = 0; i < 10; ++i) bench.step();
  EXPECT_EQ(bench.can.node().drive().power(), can_nodes::PowerState::kSwitchOnDisabled);
  const double rest_rad = bench.position_rad();
  EXPECT_GT(rest_rad, kInitial_rad + 0.1);

  bench.give({.kind = OrderKind::kEnable});
  ASSERT_TRUE(bench.run_until(Mode::kHolding, 1000));
  EXPECT_NEAR(bench.position_rad(), rest_rad, 5.0 * kCount_rad);
  bench.give({.kind = OrderKind::kSetpoint, .position_rad = -2.0, .approaches = true});
  for (int i = 0; i < 150; ++i) bench.step();
  bench.can.tell_node("emcy 0x4310");
  for (int i = 0; i < 600; ++i) bench.step();
  EXPECT_EQ(bench.fault(), Fault::kDriveFault);
  EXPECT_LT(std::abs(bench.can.node().drive().plant().state().velocity_rad_s), 1e-3);
}

TEST_P(OwnLoopInEachMode, FaultsWhenTheJointDoesNotFollow) {
  OwnLoopBench bench(joint_in(GetParam()));
  bench.can.tell_node("load 45");
  for (int i = 0; i < 300 && bench.fault() == Fault::kNone; ++i) bench.step();
  EXPECT_TRUE(bench.fault() == Fault::kFollowingError || bench.fault() == Fault::kOverload)
      << to_text(bench.fault());
}

TEST_P(OwnLoopInEachMode, ALostBusIsAFaultAndTheDriveStopsByItself) {
  OwnLoopBench bench(joint_in(GetParam()));
  bench.give({.kind = OrderKind::kSetpoint, .position_rad = 2.0, .approaches = true});
  for (int i = 0; i < 100; ++i) bench.step();
  bench.can.tell_node("cut");
  for (int i = 0; i < 1500; ++i) bench.step();
  EXPECT_NE(bench.fault(), Fault::kNone);
  EXPECT_NE(bench.can.node().drive().power(), can_nodes::PowerState::kOperationEnabled);
  EXPECT_LT(std::abs(bench.can.node().drive().plant().state().velocity_rad_s), 1e-3);
}

TEST_P(OwnLoopInEachMode, LearnsItsFrictionFromTheDrivesTorqueAlone) {
  for (const bool has_torque : {true, false}) {
    OwnLoopJoint made = joint_in(GetParam());
    JointPlantConfig& plant = made.drive.node.drive.plant;
    for (FrictionParameters* part : {&plant.joint.friction.asymptote, &plant.joint.friction.amplitude}) {
      part->static_Nm *= 1.5;
      part->coulomb_Nm *= 1.5;
    }
    if (!has_torque) made.drive.node.lacks = {0x6077};
    OwnLoopBench bench(made);
    for (int i = 0; i < 20; ++i) bench.move(i % 2 == 0 ? 1.5 : -1.5);
    const double factor = bench.loop->joint().law.controller().friction().factor();
    if (has_torque) {
      EXPECT_GT(factor, 1.2);
      EXPECT_LT(factor, 1.6);
    } else {
      EXPECT_EQ(factor, 1.0);
    }
  }
}

TEST_P(OwnLoopInEachMode, IsHomedAtALimitSwitch) {
  constexpr double kSwitch_rad = 0.1;
  OwnLoopJoint made = joint_in(GetParam());
  made.drive.config.inputs.negative_limit = true;
  HomingConfig& homing = made.joint.loop.homing;
  homing.target = HomingTarget::kLimitSwitch;
  homing.home_position_rad = -1.0;
  OwnLoopBench bench(made);
  bench.give({.kind = OrderKind::kHome});
  for (int i = 0; i < 5000 && bench.loop->mode() == Mode::kHoming; ++i) {
    bench.can.node().dictionary().set({0x60FD, 0}, bench.position_rad() < kSwitch_rad ? 1 : 0);
    bench.step();
  }
  EXPECT_EQ(bench.loop->mode(), Mode::kHolding) << to_text(bench.fault());
  // The joint's way in a period of the inputs, and the way to stop.
  EXPECT_NEAR(bench.loop->joint().zero.to_joint_rad(kSwitch_rad), -1.0, 0.002);
}

// Without SYNC the drive has stood still. A target that had moved on would have to be reached within a period.
TEST(OwnLoopInPosition, TheTargetDoesNotJumpOverAGap) {
  OwnLoopBench bench(joint_in(DriveMode::kPosition));
  bench.give({.kind = OrderKind::kSetpoint, .position_rad = 2.0, .approaches = true});
  for (int i = 0; i < 150; ++i) bench.step();
  const JointStep before = bench.motion();
  ASSERT_GT(before.order.velocity_rad_s, 1.0);
  bench.step(10);
  EXPECT_LT(bench.motion().order.position_rad - before.order.position_rad,
            1.5e-3 * before.order.velocity_rad_s);
  EXPECT_TRUE(bench.run_until(Mode::kHolding, 3000)) << to_text(bench.fault());
  EXPECT_EQ(bench.fault(), Fault::kNone);
}

TEST(OwnLoopInPosition, IsNotHomedAtAStopByADriveThatDoesNotSayItsTorque) {
  OwnLoopJoint made = joint_in(DriveMode::kPosition);
  made.drive.node.lacks = {0x6077};
  HomingConfig& homing = made.joint.loop.homing;
  homing.target = HomingTarget::kStop;
  homing.stop_torque_Nm = 5.0;
  OwnLoopBench bench(made);
  ASSERT_TRUE(bench.loop->orders().push({.id = 1000, .kind = OrderKind::kHome}));
  bench.step();
  EXPECT_EQ(bench.last_reason(), Reason::kNoHoming);
  EXPECT_EQ(bench.loop->mode(), Mode::kHolding);
}

INSTANTIATE_TEST_SUITE_P(Modes, OwnLoopInEachMode,
                         ::testing::Values(DriveMode::kVelocity, DriveMode::kPosition), [](const auto& mode) {
                           return mode.param == DriveMode::kVelocity ? "Velocity" : "Position";
                         });

TEST(OwnLoop, OrdersTheMotorWithWindUpSoThatTheLinkArrives) {
  OwnLoopJoint made = joint_in(DriveMode::kPosition);
  put_on_spring(made.joint, flexible_plant());
  made.drive.node.drive.plant.effects = flexible_plant().effects;
  // The link hangs on its spring, which 8 N.m wind up by half a milliradian.
  const GravityLoad gravity{8.0, 0.0};
  made.joint.loop.controller.gravity = gravity;
  made.drive.node.drive.plant.effects.gravity = gravity;
  made.joint.loop.initial_load_Nm = 0.0;
  OwnLoopBench bench(made, flexible_table());
  bench.move(0.8);
  EXPECT_NEAR(bench.can.node().drive().plant().link_state().position_rad, 0.8, 1e-4);
  EXPECT_GT(std::abs(bench.position_rad() - 0.8), 2e-4) << "the motor is beside it by the wind-up";
}

}  // namespace
}  // namespace strainwave::testing
