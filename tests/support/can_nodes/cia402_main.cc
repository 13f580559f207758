// SPDX-License-Identifier: BSD-3-Clause
// strainwave-can-sim INTERFACE: a simulated CiA 402 servo drive with a joint, on a CAN interface. The tests in the
// virtual machine use it. It is shipped, so that users can rehearse a joint's configuration without a drive.
#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <system_error>

#include "base/input_error.h"
#include "base/manual/command_line.h"
#include "sim/joint/reference_plant.h"
#include "tests/support/can_nodes/cia402_node.h"
#include "tests/support/can_nodes/node_program.h"

namespace strainwave::can_nodes {
namespace {

struct Options {
  std::string interface;
  std::string control;
  std::string ambient = "constant:25";
  std::string torque_side = "motor";
  double gear_ratio = kReferenceGearRatio;
  double period_s = 1e-3;
  bool reversed = false;
  int node_id = 1;
  double late_s = 0.0;
  std::vector<std::string> modes{"cst", "tq"};
  std::vector<int> temperature_object;
  std::string temperature_type = "int16";
};

void add_options(CLI::App& app, Options& options, Cia402NodeConfig& config) {
  const std::map<std::string, double> torque_units{{"mNm", 1e3}, {"uNm", 1e6}};
  ServoDriveConfig& drive = config.drive;
  app.add_option("interface", options.interface, "CAN interface, such as vcan0")->required();
  app.add_option("--node-id", options.node_id, "as joint.can.node_id")
      ->check(CLI::Range(1, 127))
      ->capture_default_str();
  app.add_option("--control", options.control, "path of a Unix datagram socket that takes commands as well");
  app.add_option("--vendor", config.vendor, "1018h:01")->capture_default_str();
  app.add_option("--product", config.product, "1018h:02")->capture_default_str();
  app.add_option("--counts-per-revolution", drive.counts_per_joint_revolution,
                 "of 6064h, per turn of the joint")
      ->capture_default_str();
  app.add_option("--rated-torque_Nm", drive.rated_torque_Nm, "on the side of --torque-side")
      ->capture_default_str();
  app.add_option("--rated-torque-unit", drive.rated_torque_units_per_Nm, "of 6076h: mNm or uNm")
      ->transform(CLI::CheckedTransformer(torque_units));
  app.add_option("--torque-side", options.torque_side, "of 6071h, 6076h and 6077h")
      ->check(CLI::IsMember({"motor", "joint"}))
      ->capture_default_str();
  app.add_option("--gear-ratio", options.gear_ratio, "reduction ratio")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--rated-current_A", drive.rated_current_A, "6075h")->capture_default_str();
  app.add_flag("--reversed", options.reversed, "the drive's positive direction is the joint's negative one");
  app.add_option("--modes", options.modes,
                 "of 6502h: cst, tq, ip, csp, csv; in the last three the drive closes its own loop")
      ->delimiter(',')
      ->capture_default_str();
  app.add_option("--ambient-temperature_C", options.ambient,
                 "temperature over time, as in the configuration of a simulated joint")
      ->capture_default_str();
  app.add_option("--temperature-object", options.temperature_object, "index and sub-index")->expected(2);
  app.add_option("--temperature-type", options.temperature_type, "of that object")
      ->check(CLI::IsMember({"int16", "real32"}))
      ->capture_default_str();
  app.add_option("--temperature-unit_C", drive.temperature.unit_C, "of one count of an int16")
      ->capture_default_str();
  app.add_option("--late_s", options.late_s,
                 "positions come so late after each SYNC of the loop, not after the single ones of start-up")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--initial-position_rad", drive.plant.initial_position_rad, "at the start")
      ->capture_default_str();
  app.add_option("--inertia_kgm2", drive.plant.joint.inertia_kgm2, "at the joint")->capture_default_str();
  app.add_option("--period_s", options.period_s, "the drive's control period")->capture_default_str();
}

void finish(const Options& options, Cia402NodeConfig& config) {
  ServoDriveConfig& drive = config.drive;
  config.node_id = static_cast<std::uint8_t>(options.node_id);
  config.late_at_rate_us = std::llround(options.late_s * 1e6);
  drive.joint_torque_per_drive_torque =
      (options.torque_side == "motor" ? options.gear_ratio : 1.0) * (options.reversed ? -1.0 : 1.0);
  drive.plant.period_s = options.period_s;
  drive.ambient = TemperatureProfile::parse(options.ambient);
  const auto has = [&](const char* mode) {
    return std::find(options.modes.begin(), options.modes.end(), mode) != options.modes.end();
  };
  drive.has_cst = has("cst");
  drive.has_tq = has("tq");
  drive.has_ip = has("ip");
  drive.has_csp = has("csp");
  drive.has_csv = has("csv");
  if (options.temperature_type == "real32") drive.temperature.type = DataType::kReal32;
  if (options.temperature_object.size() == 2)
    drive.temperature.key = {static_cast<std::uint16_t>(options.temperature_object[0]),
                             static_cast<std::uint8_t>(options.temperature_object[1])};
}

ExitStatus run(const Options& options, Cia402NodeConfig& config) {
  finish(options, config);
  try {
    // Network management, SYNC, heartbeats, and this node's part of the predefined connection set.
    CanPort port(options.interface, {{0x000}, {0x080}, {0x700, 0x780}, {config.node_id, 0x07F}});
    BusAndRecord output(port);
    Cia402Node node(config, output);
    run_node(node, port, output, options.control);
  } catch (const std::system_error& error) {
    throw InputError(std::string(error.what()) + "; a virtual bus is made by root: ip link add dev " +
                     options.interface + " type vcan; ip link set " + options.interface + " up");
  }
  return ExitStatus::kDone;
}

}  // namespace
}  // namespace strainwave::can_nodes

int main(int argc, char** argv) {
  using namespace strainwave;
  CLI::App program(
      "Simulates a CiA 402 servo drive with a joint behind it on a CAN interface, to rehearse a "
      "configuration "
      "without a drive. It answers until SIGINT or SIGTERM, and records what happens on standard output. "
      "Lines on standard input make it misbehave: cut, reconnect, reboot, emcy CODE, heartbeat off, "
      "skip-tpdo COUNT, late-tpdo US COUNT, load TORQUE_NM, report, quit.");
  configure_program(
      program,
      {.program = "strainwave-can-sim",
       .files = {{"/usr/share/doc/strainwave/docs/bring-up.md", "what to rehearse with it, and how"}},
       .examples = {{"strainwave-can-sim vcan0",
                     "the drive of config/epos4.toml, but for its unit of torque"},
                    {"strainwave-can-sim vcan0 --rated-torque-unit uNm --reversed",
                     "in uNm, and turning the other way"},
                    {"strainwave-can-sim vcan0 --late_s 0.003", "a drive whose positions come 3 ms late"}},
       .see_also = {"strainwaved(8)", "strainwavectl(1)"}});
  can_nodes::Options options;
  can_nodes::Cia402NodeConfig config;
  // The bus already has the plant's period of delay: a reading was sampled at the last SYNC.
  config.drive.plant = realistic_plant();
  config.drive.plant.delay.periods = 0.0;
  can_nodes::add_options(program, options, config);
  return run_program(program, argc, argv, [&] { return can_nodes::run(options, config); });
}
