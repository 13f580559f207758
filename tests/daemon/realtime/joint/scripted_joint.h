// SPDX-License-Identifier: BSD-3-Clause
// A joint's loop on a drive that says whatever the test wants: limits and faults that no simulated drive shows by itself.
// Virtual time.
#pragma once

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {

class ScriptedActuator final : public Actuator {
 public:
  ActuatorReading read(std::int64_t) noexcept override { return reading; }
  void write(const ActuatorCommand& command) noexcept override { last = command; }
  void stop() noexcept override {
    last = {};
    ++stops;
  }
  void clear_fault() noexcept override { reading.fault = ActuatorFault::kNone; }

  ActuatorReading reading;
  ActuatorCommand last;
  int stops = 0;
};

class ScriptedJoint : public ::testing::Test {
 protected:
  ScriptedJoint() {
    config_ = demo_joint().loop;
    config_.start_timeout_s = 0.1;
    config_.stop_timeout_s = 0.2;
    config_.missed_readings_limit = 5;
    make();
  }
  void make() {
    cycle_ = 0;
    auto drive = std::make_unique<ScriptedActuator>();
    drive_ = drive.get();
    drive_->reading.has_position = true;
    drive_->reading.has_temperature = true;
    drive_->reading.temperature_C = 25.0;
    loop_ = std::make_unique<JointLoop>(0, config_, std::move(drive), replies_, events_);
    loop_->table_slot(0) = {demo_table(), 1};
    order(OrderKind::kUseTable);
  }
  void step() {
    drive_->reading.joint_position_rad += drifting_rad_s_ * 0.001;
    const std::int64_t now_ns = 1'000'000'000 + ++cycle_ * 1'000'000;
    drive_->reading.temperature_produced_ns = now_ns;
    loop_->step({now_ns, cycle_});
  }
  /// Long enough to be seen not to move.
  void stand() {
    for (int i = 0; i < 200; ++i) step();
  }
  Reason order(OrderKind kind) {
    loop_->orders().push({1, kind, 0, 0.0, 0.0, {}});
    step();
    return replies_.pop(last_reply_) ? last_reply_.reason : Reason::kTimedOut;
  }
  void hold() {
    ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
    drive_->reading.drive_state = DriveState::kEnabled;
    step();
    ASSERT_EQ(loop_->mode(), Mode::kHolding);
  }
  Fault fault() const { return static_cast<Fault>(loop_->record().state.fault); }
  /// Cycles until the fault, counting the first one as 1; 0 when none comes within `limit`.
  int cycles_until_fault(int limit) {
    for (int cycles = 1; cycles <= limit; ++cycles) {
      step();
      if (fault() != Fault::kNone) return cycles;
    }
    return 0;
  }

  ReplyQueue replies_;
  EventQueue events_;
  JointLoopConfig config_;
  ScriptedActuator* drive_ = nullptr;
  std::unique_ptr<JointLoop> loop_;
  Reply last_reply_;
  std::int64_t cycle_ = 0;
  double drifting_rad_s_ = 0.0;
};

}  // namespace strainwave::testing
