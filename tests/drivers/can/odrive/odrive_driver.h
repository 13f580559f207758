// SPDX-License-Identifier: BSD-3-Clause
// Shared by tests of the ODrive driver: the driver and the independent simulated axis of tests/support/can_nodes, on a bus in virtual time.
#pragma once

#include <gtest/gtest.h>

#include "drivers/can/can_bus.h"
#include "drivers/can/can_detail.h"
#include "drivers/can/odrive/odrive_node.h"
#include "sim/joint/reference_plant.h"
#include "tests/support/can_nodes/odrive_node.h"
#include "tests/support/refusal.h"
#include "tests/support/virtual_can.h"

namespace strainwave::testing {

inline constexpr std::int64_t kPeriod_ns = 1'000'000;
inline constexpr ActuatorCommand kMoving{10.0, true};
inline constexpr ActuatorCommand kOff{0.0, false};

class OdriveDriver : public ::testing::Test {
 protected:
  OdriveDriver() {
    node_config_.node_id = 2;
    node_config_.plant = realistic_plant();
    node_config_.plant.delay.periods = 0.0;
    node_config_.encoder_us = 1000;
    node_config_.temperature_us = 100000;
    config_.name = "elbow";
    config_.node_id = 2;
    config_.units.encoder_turns_per_joint_turn = kReferenceGearRatio;
    config_.units.gear_ratio = kReferenceGearRatio;
    config_.torque_limit_Nm = 20.0;
    config_.watchdog = odrive::WatchdogEndpoints{190, 191};
  }

  void start() {
    axis_ = &can_.add<can_nodes::OdriveNode>(node_config_);
    can_.run_to(can_.now_ns() + 100 * kPeriod_ns);
    CanBusConfig bus;
    bus.interface_name = "can0";
    bus.sync = SyncProducer::kNone;
    bus.background_thread = false;
    std::vector<std::unique_ptr<CanNode>> nodes;
    nodes.push_back(std::make_unique<odrive::Node>(config_));
    bus_ = std::make_unique<CanBus>(bus, std::move(nodes), can_.factory());
    joint_ = bus_->make_actuator(0);
  }
  std::string refusal() {
    return testing::refusal_of([&] { start(); });
  }
  void step(const ActuatorCommand& command) {
    can_.run_to(can_.now_ns() + kPeriod_ns);
    bus_->begin_cycle(can_.now_ns());
    reading_ = joint_->read(can_.now_ns());
    joint_->write(command);
    bus_->end_cycle();
  }
  void run(int periods, const ActuatorCommand& command) {
    for (int i = 0; i < periods; ++i) step(command);
  }
  bool enable() {
    for (int i = 0; i < 400 && reading_.drive_state != DriveState::kEnabled; ++i) step({0.0, true});
    return reading_.drive_state == DriveState::kEnabled;
  }
  int periods_until_fault(int limit) {
    for (int i = 1; i <= limit; ++i) {
      step(kMoving);
      if (reading_.fault != ActuatorFault::kNone) return i;
    }
    return 0;
  }
  CanDetail detail() const { return detail_of(reading_.drive_error & ~odrive::kOurDetail); }
  void tell(const std::string& line) { EXPECT_EQ(axis_->command(line, can_.now_ns() / 1000), "") << line; }
  void start_moving() {
    start();
    ASSERT_TRUE(enable());
    run(50, kMoving);
    ASSERT_GT(axis_->plant().state().velocity_rad_s, 0.5);
  }

  can_nodes::OdriveNodeConfig node_config_;
  odrive::DriveConfig config_;
  VirtualCan can_;
  can_nodes::OdriveNode* axis_ = nullptr;
  std::unique_ptr<CanBus> bus_;
  std::unique_ptr<Actuator> joint_;
  ActuatorReading reading_;
};

}  // namespace strainwave::testing
