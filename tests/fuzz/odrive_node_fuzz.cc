// SPDX-License-Identifier: BSD-3-Clause
// An ODrive axis that sends arbitrary frames after a correct set-up.
#include "drivers/can/odrive/odrive_node.h"

#include "sim/joint/reference_plant.h"
#include "tests/fuzz/node_cycles.h"
#include "tests/support/can_nodes/odrive_node.h"
#include "tests/support/virtual_can.h"

namespace strainwave::fuzz {
namespace {

constexpr std::uint8_t kNode = 2;

can_nodes::OdriveNodeConfig simulated_axis() {
  can_nodes::OdriveNodeConfig config;
  config.node_id = kNode;
  config.boot_us = 1000;
  config.plant = realistic_plant();
  return config;
}

odrive::DriveConfig driver_config() {
  odrive::DriveConfig config;
  config.name = "joint";
  config.node_id = kNode;
  config.units.encoder_turns_per_joint_turn = config.units.gear_ratio = kReferenceGearRatio;
  config.torque_limit_Nm = 20.0;
  config.watchdog = odrive::WatchdogEndpoints{190, 191};
  return config;
}

bool has_torque(const CanFrame& frame) {
  return frame.id == odrive::can_id(odrive::Command::kSetTorque, kNode) &&
         little_endian(frame.bytes.data(), 4) << 1U != 0;
}

}  // namespace
}  // namespace strainwave::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  fuzz::FuzzInput input(data, size);
  strainwave::testing::VirtualCan can;
  can.add<can_nodes::OdriveNode>(fuzz::simulated_axis());
  can.run_to(can.now_ns() + 2 * fuzz::kPeriod_ns);
  odrive::Node node(fuzz::driver_config());
  CanPortOptions options;
  options.receive_ids = node.setup_ids();
  const std::unique_ptr<CanPort> port = can.factory()(options);
  node.set_up(*port);
  fuzz::run_cycles(node, input, can.now_ns(), fuzz::has_torque);
  return 0;
}
