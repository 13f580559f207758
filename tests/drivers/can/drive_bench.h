// SPDX-License-Identifier: BSD-3-Clause
// Joints with CiA 402 drives on a bus in virtual time: the real bus and node of drivers/can, the independent
// simulated drives of tests/support/can_nodes, a period per step.
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

/// A drive as the node is made, and as the configuration describes it.
struct BenchDrive {
  can_nodes::Cia402NodeConfig node;
  cia402::DriveConfig config;
};
/// The catalogue's joint on node `node_id`, with a temperature over PDO.
BenchDrive bench_drive(std::uint8_t node_id);

class DriveBench {
 public:
  static constexpr std::int64_t kPeriod_ns = 1'000'000;
  explicit DriveBench(std::vector<BenchDrive> drives);

  /// Makes the bus, which sets the drives up. Throws InputError.
  void start();
  /// The message of start(), which must throw.
  std::string start_refusal();

  /// One period: `command` for the first joint, the others stay disabled unless all_ say otherwise.
  void step(const ActuatorCommand& command);
  void run(int periods, const ActuatorCommand& command);
  /// Steps with torque 0 until the first joint is enabled; false when it does not come.
  bool enable(int limit = 200);
  /// Periods until the first joint reports a fault, the first counted as 1; 0: none within `limit`.
  int periods_until_fault(int limit, const ActuatorCommand& command);
  /// As the joint loop does it: stops until the drive obeys, clears, and lets the background thread work.
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
  /// What the bus had to say, a line each.
  std::string said();
  /// Frames with this identifier since `since_ns`.
  std::vector<CanFrame> frames(std::uint32_t id, std::int64_t since_ns) const;

 private:
  std::vector<BenchDrive> drives_;
  CanBusConfig bus_config_;
  VirtualCan can_;
  std::vector<can_nodes::Cia402Node*> nodes_;
  std::unique_ptr<CanBus> bus_;
  std::vector<std::unique_ptr<Actuator>> actuators_;
  std::vector<ActuatorReading> readings_;
  bool clear_ordered_ = false;  ///< in the next period, where the joint loop obeys orders
};

}  // namespace strainwave::testing
