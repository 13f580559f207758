// SPDX-License-Identifier: BSD-3-Clause
// A CiA 402 drive that sends arbitrary frames after a correct set-up.
#include "drivers/can/cia402/cia402_node.h"

#include "sim/joint/reference_plant.h"
#include "tests/fuzz/node_cycles.h"
#include "tests/support/can_nodes/cia402_node.h"
#include "tests/support/virtual_can.h"

namespace strainwave::fuzz {
namespace {

can_nodes::Cia402NodeConfig simulated_drive(bool real_temperature) {
  can_nodes::Cia402NodeConfig config;
  config.node_id = 3;
  config.boot_us = 1000;
  config.drive.plant = realistic_plant();
  if (real_temperature) config.drive.temperature.type = can_nodes::DataType::kReal32;
  return config;
}

cia402::DriveConfig driver_config(bool real_temperature, bool velocity) {
  cia402::DriveConfig config;
  config.name = "joint";
  config.node_id = 3;
  config.units.counts_per_output_revolution = 320000;
  config.units.gear_ratio = kReferenceGearRatio;
  config.units.torque_constant_Nm_A = 0.192;
  config.units.velocity_rad_s_per_unit = velocity ? 1e-5 : 0.0;
  config.torque_limit_Nm = 20.0;
  const auto type = real_temperature ? cia402::NumberType::kReal32 : cia402::NumberType::kInt16;
  config.temperature =
      cia402::TemperatureObject{{0x3201, 1}, type, 0.1, 0.0, cia402::TemperatureObject::Way::kPdo, 0.1};
  return config;
}

}  // namespace
}  // namespace strainwave::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  fuzz::FuzzInput input(data, size);
  const std::uint8_t kind = input.byte();
  const bool real_temperature = (kind & 1U) != 0;
  strainwave::testing::VirtualCan can;
  can.add<can_nodes::Cia402Node>(fuzz::simulated_drive(real_temperature));
  cia402::Node node(fuzz::driver_config(real_temperature, (kind & 2U) != 0));
  CanPortOptions options;
  options.receive_ids = node.setup_ids();
  const std::unique_ptr<CanPort> port = can.factory()(options);
  node.set_up(*port);
  fuzz::run_cycles(node, input, can.now_ns(),
                   [](const CanFrame& frame) { return little_endian(&frame.bytes[2], 2) != 0; });
  return 0;
}
