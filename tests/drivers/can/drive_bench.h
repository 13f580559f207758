// SPDX-License-Identifier: BSD-3-Clause
// Joints with CiA 402 drives on a bus in virtual time. It uses the real bus and node of drivers/can and the independent simulated drives of
// tests/support/can_nodes. Each step is a period.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/can/can_bus.h"
#include "drivers/can/cia402/cia402_node.h"
#include "tests/support/can_nodes/cia402_node.h"
#include "tests/support/refusal.h"
#include "tests/support/virtual_can.h"

namespace strainwave::testing {

/// A drive: its simulated node and its configuration.
struct BenchDrive {
  can_nodes::Cia402NodeConfig node;
  cia402::DriveConfig config;
};
/// The catalogue's joint on node `node_id`, with its temperature in a PDO.
BenchDrive bench_drive(std::uint8_t node_id);

class DriveBench {
 public:
  static constexpr std::int64_t kPeriod_ns = 1'000'000;
  explicit DriveBench(std::vector<BenchDrive> drives);

  /// Creates the bus, which sets the drives up. Throws InputError.
  void start();
  /// Returns the message of start(), which must throw.
  std::string start_refusal();

  /// Runs one period with `command` for every joint.
  void step(const ActuatorCommand& command);
  void run(int periods, const ActuatorCommand& command);
  /// Steps with torque 0 until all joints are enabled. Returns false if `limit` periods do not suffice.
  bool enable(int limit = 200);
  /// Returns the periods until the first joint reports a fault, counted from 1, or 0 if there is none within `limit`.
  int periods_until_fault(int limit, const ActuatorCommand& command);
  /// Acts as the joint loop does: stops until the drive obeys, clears, and lets the background thread work.
  void clear(int periods = 100);

  const ActuatorReading& reading(std::size_t joint = 0) const { return readings_[joint]; }
  can_nodes::Cia402Node& node(std::size_t joint = 0) { return *nodes_[joint]; }
  void tell_node(const std::string& line, std::size_t joint = 0);
  VirtualCan& can() { return can_; }
  CanBus& bus() { return *bus_; }
  CanBusConfig& bus_config() { return bus_config_; }
  cia402::DriveConfig& config(std::size_t joint = 0) { return drives_[joint].config; }
  Actuator& actuator(std::size_t joint = 0) { return *actuators_[joint]; }
  void end() { bus_.reset(); }
  /// Returns the messages of the bus, one a line.
  std::string said();
  /// Returns the frames with this identifier since `since_ns`.
  std::vector<CanFrame> frames(std::uint32_t id, std::int64_t since_ns) const;

 private:
  std::vector<BenchDrive> drives_;
  CanBusConfig bus_config_;
  VirtualCan can_;
  std::vector<can_nodes::Cia402Node*> nodes_;
  std::unique_ptr<CanBus> bus_;
  std::vector<std::unique_ptr<Actuator>> actuators_;
  std::vector<ActuatorReading> readings_;
  bool clear_ordered_ = false;  ///< the next step clears the faults, as the joint loop obeys an order
};

}  // namespace strainwave::testing
