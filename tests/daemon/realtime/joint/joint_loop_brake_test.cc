// SPDX-License-Identifier: BSD-3-Clause
// A joint whose brake holds a load: taken over under torque, without a fall. Virtual time.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "drivers/simulated_actuator.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {
namespace {

constexpr double kLoad_Nm = 15.0;
constexpr std::int64_t kMillisecond_ns = 1'000'000;

/// The simulated joint with a brake: while that is shut it takes the motor's torque and the load. It opens `release_ns` after the
/// drive gives torque, and shuts at once.
class BrakedDrive final : public Actuator {
 public:
  BrakedDrive(const SimulatedActuatorConfig& config, std::int64_t release_ns)
      : drive_(config), release_ns_(release_ns) {}

  ActuatorReading read(std::int64_t now_ns) noexcept override {
    now_ns_ = now_ns;
    ActuatorReading reading = drive_.read(now_ns);
    const bool wanted = command.enable && reading.drive_state == DriveState::kEnabled;
    if (!wanted) wanted_since_ns_ = now_ns;
    open = wanted && now_ns - wanted_since_ns_ >= release_ns_;
    drive_.set_load_torque_Nm(open ? kLoad_Nm : command.torque_Nm);
    reading.brake_shut = wanted && !open;
    return reading;
  }
  void write(const ActuatorCommand& order) noexcept override {
    command = order;
    drive_.write(order);
  }
  void stop() noexcept override {
    command = {};
    open = false;
    ++stops;
    drive_.set_load_torque_Nm(0.0);
    drive_.stop();
  }
  void clear_fault() noexcept override { drive_.clear_fault(); }
  double position_rad() const { return drive_.plant().state().position_rad; }

  ActuatorCommand command;
  bool open = false;
  int stops = 0;

 private:
  SimulatedActuator drive_;
  std::int64_t release_ns_;
  std::int64_t now_ns_ = 0;
  std::int64_t wanted_since_ns_ = 0;
};

class JointLoopBrake : public ::testing::Test {
 protected:
  void make(double initial_load_Nm, std::int64_t release_ns = 100 * kMillisecond_ns) {
    BenchJoint joint = demo_joint();
    joint.loop.initial_load_Nm = initial_load_Nm;
    auto drive = std::make_unique<BrakedDrive>(joint.drive, release_ns);
    drive_ = drive.get();
    loop_ = std::make_unique<JointLoop>(0, joint.loop, std::move(drive), replies_, events_);
    loop_->table_slot(0) = {demo_table(), 1};
    ASSERT_EQ(order(OrderKind::kUseTable), Reason::kAccepted);
    run(300);
  }
  void step() {
    ++time_.cycle;
    time_.now_ns += kMillisecond_ns;
    loop_->step(time_);
    lowest_rad_ = std::min(lowest_rad_, drive_->position_rad());
    highest_rad_ = std::max(highest_rad_, drive_->position_rad());
  }
  void run(int periods) {
    for (int i = 0; i < periods; ++i) step();
  }
  bool run_until(Mode mode, int limit = 5000) {
    for (int i = 0; i < limit && loop_->mode() != mode; ++i) step();
    return loop_->mode() == mode;
  }
  Reason order(OrderKind kind) {
    Order order;
    order.kind = kind;
    return this->order(order);
  }
  Reason order(Order order) {
    order.id = 1;
    loop_->orders().push(order);
    step();
    return replies_.pop(last_reply_) ? last_reply_.reason : Reason::kTimedOut;
  }
  /// How far the joint leaves its place while it is enabled and for a second after.
  double sag_rad() {
    lowest_rad_ = highest_rad_ = drive_->position_rad();
    const double before_rad = drive_->position_rad();
    EXPECT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
    EXPECT_TRUE(run_until(Mode::kHolding));
    run(1000);
    EXPECT_EQ(loop_->mode(), Mode::kHolding);
    return std::max(before_rad - lowest_rad_, highest_rad_ - before_rad);
  }
  ReplyQueue replies_;
  Reply last_reply_;
  EventQueue events_;
  BrakedDrive* drive_ = nullptr;
  std::unique_ptr<JointLoop> loop_;
  CycleTime time_{1'000'000'000, 0};
  double lowest_rad_ = 0.0;
  double highest_rad_ = 0.0;
};

TEST_F(JointLoopBrake, TakesOverALoadThatItKnowsWithoutASag) {
  make(kLoad_Nm);
  EXPECT_LT(sag_rad(), 0.001);
}

TEST_F(JointLoopBrake, RefusesATableThatCannotHoldTheLoadThatIsHeld) {
  make(kLoad_Nm);
  EXPECT_LT(sag_rad(), 0.001);
  loop_->table_slot(1) = {demo_table(), 2};
  loop_->table_slot(1).table.torque_limit_Nm = 8.0;
  const Order swap{.kind = OrderKind::kUseTable, .table_slot = 1};
  EXPECT_EQ(order(swap), Reason::kOutOfRange);
  EXPECT_EQ(last_reply_.value, 8.0);
  EXPECT_NEAR(last_reply_.limit, kLoad_Nm, 0.5);
  run(1000);
  EXPECT_EQ(loop_->mode(), Mode::kHolding);
  loop_->table_slot(1).table.torque_limit_Nm = 30.0;
  EXPECT_EQ(order(swap), Reason::kAccepted);
}

TEST_F(JointLoopBrake, CatchesALoadThatItDoesNotKnowWithinFifteenMilliradians) {
  make(0.0);
  EXPECT_LT(sag_rad(), 0.015);
}

TEST_F(JointLoopBrake, KnowsTheLoadTheNextTimeFromWhatItHeldBefore) {
  make(0.0);
  (void)sag_rad();
  run(2000);
  ASSERT_EQ(order(OrderKind::kDisable), Reason::kAccepted);
  ASSERT_TRUE(run_until(Mode::kOff));
  run(300);
  EXPECT_LT(sag_rad(), 0.002);
}

TEST_F(JointLoopBrake, OpensUnderTheTorqueThatHoldsThePositionFromTheFirstCycleOn) {
  make(kLoad_Nm);
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  ASSERT_TRUE(run_until(Mode::kReleasing));
  for (; !drive_->open; step()) EXPECT_NEAR(drive_->command.torque_Nm, kLoad_Nm, 0.5);
}

TEST_F(JointLoopBrake, ThatOpensRefusesMotionUntilItIsOpen) {
  make(kLoad_Nm);
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  ASSERT_TRUE(run_until(Mode::kReleasing));
  Order move;
  move.kind = OrderKind::kSetpoint;
  move.position_rad = 0.5;
  EXPECT_EQ(order(move), Reason::kWrongMode);
  EXPECT_EQ(order(OrderKind::kHome), Reason::kNoHoming);
  ASSERT_TRUE(run_until(Mode::kHolding));
  EXPECT_TRUE(drive_->open);
  EXPECT_EQ(order(move), Reason::kAccepted);
}

TEST_F(JointLoopBrake, ThatDoesNotOpenInTimeIsAFault) {
  make(kLoad_Nm, 1'000'000 * kMillisecond_ns);
  ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
  ASSERT_TRUE(run_until(Mode::kFaulted));
  EXPECT_EQ(loop_->record().state.fault, static_cast<int>(Fault::kStartTimeout));
  EXPECT_FALSE(drive_->command.enable);
}

TEST_F(JointLoopBrake, IsShutInTheCycleOfAFault) {
  make(kLoad_Nm);
  (void)sag_rad();
  ASSERT_TRUE(drive_->open);
  ++time_.cycle;
  time_.now_ns += kMillisecond_ns;
  loop_->joint().raise_fault(Fault::kGroup, time_);
  loop_->step(time_);
  EXPECT_EQ(drive_->stops, 1);
  EXPECT_FALSE(drive_->open);
}

}  // namespace
}  // namespace strainwave::testing
