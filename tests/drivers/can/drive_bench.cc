// SPDX-License-Identifier: BSD-3-Clause
#include "tests/drivers/can/drive_bench.h"

#include <gtest/gtest.h>

#include "sim/joint/reference_plant.h"
#include "tests/support/refusal.h"

namespace strainwave::testing {

BenchDrive bench_drive(std::uint8_t node_id) {
  BenchDrive drive;
  drive.node.node_id = node_id;
  drive.node.drive.plant = realistic_plant();
  drive.node.drive.plant.delay.periods = 0.0;
  cia402::DriveConfig& config = drive.config;
  config.name = "joint" + std::to_string(node_id);
  config.node_id = node_id;
  config.units.counts_per_output_revolution = 320000;
  config.units.gear_ratio = kReferenceGearRatio;
  config.units.torque_constant_Nm_A = 0.192;
  config.torque_limit_Nm = 20.0;
  config.absolute_encoder = true;
  config.temperature = cia402::TemperatureObject{{0x3201, 1}, cia402::NumberType::kInt16,           0.1,
                                                 0.0,         cia402::TemperatureObject::Way::kPdo, 0.1};
  return drive;
}

DriveBench::DriveBench(std::vector<BenchDrive> drives)
    : drives_(std::move(drives)), readings_(drives_.size()) {
  bus_config_.interface_name = "can0";
  bus_config_.heartbeat_period_s = 0.05;
  bus_config_.load_limit = 1.0;
  bus_config_.background_thread = false;
  for (const BenchDrive& drive : drives_) nodes_.push_back(&can_.add<can_nodes::Cia402Node>(drive.node));
}

void DriveBench::start() {
  std::vector<std::unique_ptr<CanNode>> nodes;
  for (const BenchDrive& drive : drives_) nodes.push_back(std::make_unique<cia402::Node>(drive.config));
  bus_ = std::make_unique<CanBus>(bus_config_, std::move(nodes), can_.factory());
  actuators_.clear();
  for (std::size_t i = 0; i < drives_.size(); ++i) actuators_.push_back(bus_->make_actuator(i));
}

std::string DriveBench::start_refusal() {
  return testing::refusal_of([&] { start(); });
}

void DriveBench::step(const ActuatorCommand& command) {
  can_.run_to(can_.now_ns() + kPeriod_ns);
  bus_->begin_cycle(can_.now_ns());
  for (std::size_t i = 0; i < actuators_.size(); ++i) {
    if (clear_ordered_) actuators_[i]->clear_fault();
    readings_[i] = actuators_[i]->read(can_.now_ns());
    actuators_[i]->write(command);
  }
  clear_ordered_ = false;
  bus_->end_cycle();
}

void DriveBench::run(int periods, const ActuatorCommand& command) {
  for (int i = 0; i < periods; ++i) step(command);
}

bool DriveBench::enable(int limit) {
  for (int i = 0; i < limit; ++i) {
    step({0.0, true});
    bool all = true;
    for (const ActuatorReading& reading : readings_) all = all && reading.drive_state == DriveState::kEnabled;
    if (all) return true;
  }
  return false;
}

int DriveBench::periods_until_fault(int limit, const ActuatorCommand& command) {
  for (int i = 1; i <= limit; ++i) {
    step(command);
    if (readings_[0].fault != ActuatorFault::kNone) return i;
  }
  return 0;
}

void DriveBench::clear(int periods) {
  for (int i = 0; i < periods && readings_[0].drive_state != DriveState::kDisabled; ++i) {
    for (const auto& actuator : actuators_) actuator->stop();
    step({0.0, false});
  }
  clear_ordered_ = true;
  step({0.0, false});
  bus_->serve();
  run(periods, {0.0, false});
}

void DriveBench::tell_node(const std::string& line, std::size_t joint) {
  EXPECT_EQ(nodes_[joint]->command(line, can_.now_ns() / 1000), "") << line;
}

std::string DriveBench::said() {
  std::string text;
  for (const std::string& line : bus_->take_messages()) text += line + '\n';
  return text;
}

std::vector<CanFrame> DriveBench::frames(std::uint32_t id, std::int64_t since_ns) const {
  std::vector<CanFrame> result;
  for (const VirtualCan::Entry& entry : can_.trace())
    if (entry.frame.id == id && entry.time_ns >= since_ns) result.push_back(entry.frame);
  return result;
}

}  // namespace strainwave::testing
