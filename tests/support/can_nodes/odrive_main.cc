// SPDX-License-Identifier: BSD-3-Clause
// odrive-node INTERFACE --node-id N ...: a simulated ODrive axis with a joint, on a CAN interface.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "sim/joint/reference_plant.h"
#include "tests/support/can_nodes/node_program.h"
#include "tests/support/can_nodes/odrive_node.h"

namespace strainwave::can_nodes {
namespace {

int run(int argc, char** argv) {
  CLI::App app("A simulated ODrive axis with a joint behind it.", "odrive-node");
  OdriveNodeConfig config;
  config.plant = realistic_plant();
  config.plant.delay.periods = 0.0;
  config.plant.period_s = 0.5e-3;  // the drive's own control period, almost continuous at 1 kHz
  config.plant.substeps = 5;
  std::string interface;
  std::string control;
  std::string ambient = "constant:25";
  double gear_ratio = kReferenceGearRatio;
  double encoder_ms = 10.0;
  double heartbeat_ms = 100.0;
  double temperature_ms = 0.0;
  double torques_ms = 0.0;
  int node_id = 0;
  std::string encoder_side = "motor";
  bool reversed = false;
  app.add_option("interface", interface, "CAN interface, such as vcan0")->required();
  app.add_option("--node-id", node_id)->check(CLI::Range(0, 63));
  app.add_option("--control", control, "path of the Unix datagram socket that takes commands");
  app.add_option("--gear-ratio", gear_ratio)->check(CLI::PositiveNumber);
  app.add_option("--encoder-side", encoder_side)->check(CLI::IsMember({"motor", "joint"}));
  app.add_flag("--reversed", reversed, "the drive's positive direction is the joint's negative one");
  app.add_option("--counts-per-revolution", config.counts_per_joint_revolution, "per turn of the joint");
  app.add_option("--firmware", config.version.firmware, "three numbers")->expected(3);
  app.add_option("--ambient-temperature_C", ambient,
                 "temperature over time, as in the configuration of a simulated joint");
  app.add_option("--watchdog_s", config.watchdog_timeout_s, "its time-out");
  app.add_option("--watchdog-enabled", config.watchdog_enabled);
  app.add_option("--encoder_ms", encoder_ms, "period of the cyclic encoder message; 0: on request only");
  app.add_option("--heartbeat_ms", heartbeat_ms, "period of the heartbeat");
  app.add_option("--temperature_ms", temperature_ms,
                 "period of the cyclic temperature message; 0: on request only");
  app.add_option("--torques_ms", torques_ms, "period of the cyclic torque message; 0: on request only");
  app.add_option("--input-vel-scale", config.velocity_units_per_turn_s, "of the velocity beside a position");
  CLI11_PARSE(app, argc, argv);

  config.node_id = static_cast<std::uint8_t>(node_id);
  const double sign = reversed ? -1.0 : 1.0;
  config.joint_turns_per_encoder_turn = sign * (encoder_side == "motor" ? 1.0 / gear_ratio : 1.0);
  config.joint_torque_per_drive_torque = sign * gear_ratio;
  config.ambient = TemperatureProfile::parse(ambient);
  config.encoder_us = static_cast<std::int64_t>(encoder_ms * 1e3);
  config.heartbeat_us = static_cast<std::int64_t>(heartbeat_ms * 1e3);
  config.torques_us = static_cast<std::int64_t>(torques_ms * 1e3);
  config.temperature_us = static_cast<std::int64_t>(temperature_ms * 1e3);
  CanPort port(interface, {{static_cast<std::uint32_t>(config.node_id) << 5, 0x7E0}});
  BusAndRecord output(port);
  OdriveNode node(config, output);
  return run_node(node, port, output, control);
}

}  // namespace
}  // namespace strainwave::can_nodes

int main(int argc, char** argv) {
  try {
    return strainwave::can_nodes::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "odrive-node: %s\n", error.what());
    return 1;
  }
}
