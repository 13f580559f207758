// SPDX-License-Identifier: BSD-3-Clause
// A joint's loop on a drive whose readings the test sets, for limits and faults that no simulated drive shows
// by itself. Virtual time.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>

#include "tests/support/joint_bench.h"

namespace strainwave::testing {

class ScriptedActuator final : public Actuator {
 public:
  ActuatorReading read(std::int64_t now_ns) noexcept override {
    reading.joint_position_rad += drifting_rad_s * 0.001;
    reading.temperature_produced_ns = now_ns;
    return reading;
  }
  void write(const ActuatorCommand& command) noexcept override { last = command; }
  void stop() noexcept override {
    last = {};
    ++stops;
  }
  void clear_fault() noexcept override { reading.fault = ActuatorFault::kNone; }

  ActuatorReading reading;
  ActuatorCommand last;
  double drifting_rad_s = 0.0;
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
    auto drive = std::make_unique<ScriptedActuator>();
    drive_ = drive.get();
    drive_->reading.has_position = true;
    drive_->reading.has_temperature = true;
    drive_->reading.temperature_C = 25.0;
    bench_.emplace(config_, std::move(drive));
    loop_ = &bench_->joint(0);
    loop_->table_slot(0) = {demo_table(), 1};
    order(OrderKind::kUseTable);
  }
  void step() { bench_->step(); }
  /// Stands still until the loop regards the joint as at rest.
  void stand() {
    for (int i = 0; i < 200; ++i) step();
  }
  Reason order(OrderKind kind) { return bench_->order(0, kind); }
  void hold() {
    ASSERT_EQ(order(OrderKind::kEnable), Reason::kAccepted);
    drive_->reading.drive_state = DriveState::kEnabled;
    step();
    ASSERT_EQ(loop_->mode(), Mode::kHolding);
  }
  Fault fault() const { return bench_->fault(0); }
  /// Cycles until the fault, with the first one as 1, or 0 if none comes within `limit`.
  int cycles_until_fault(int limit) {
    for (int cycles = 1; cycles <= limit; ++cycles) {
      step();
      if (fault() != Fault::kNone) return cycles;
    }
    return 0;
  }

  JointLoopConfig config_;
  std::optional<JointBench> bench_;
  ScriptedActuator* drive_ = nullptr;
  JointLoop* loop_ = nullptr;
};

}  // namespace strainwave::testing
