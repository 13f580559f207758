// cia402-node INTERFACE --node-id N ...: a simulated CiA 402 servo drive with a joint behind it, on a CAN interface.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <map>

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
  std::vector<std::string> modes{"cst", "tq"};
  std::vector<int> temperature_object;
  std::string temperature_type = "int16";
};

void add_options(CLI::App& app, Options& options, Cia402NodeConfig& config) {
  const std::map<std::string, double> torque_units{{"mNm", 1e3}, {"uNm", 1e6}};
  ServoDriveConfig& drive = config.drive;
  app.add_option("interface", options.interface, "CAN interface, such as vcan0")->required();
  app.add_option("--node-id", options.node_id)->check(CLI::Range(1, 127));
  app.add_option("--control", options.control, "path of the Unix datagram socket that takes commands");
  app.add_option("--vendor", config.vendor, "1018h:1");
  app.add_option("--product", config.product, "1018h:2");
  app.add_option("--counts-per-revolution", drive.counts_per_joint_revolution,
                 "of 6064h, per turn of the joint");
  app.add_option("--rated-torque_Nm", drive.rated_torque_Nm, "on the side of --torque-side");
  app.add_option("--rated-torque-unit", drive.rated_torque_units_per_Nm, "of 6076h: mNm or uNm")
      ->transform(CLI::CheckedTransformer(torque_units));
  app.add_option("--torque-side", options.torque_side)->check(CLI::IsMember({"motor", "joint"}));
  app.add_option("--gear-ratio", options.gear_ratio)->check(CLI::PositiveNumber);
  app.add_option("--rated-current_A", drive.rated_current_A, "6075h");
  app.add_flag("--reversed", options.reversed, "the drive's positive direction is the joint's negative one");
  app.add_option("--modes", options.modes, "of 6502h: cst, tq")->delimiter(',');
  app.add_option("--ambient-temperature_C", options.ambient,
                 "temperature over time, as in the configuration of a simulated joint");
  app.add_option("--temperature-object", options.temperature_object, "index and sub-index")->expected(2);
  app.add_option("--temperature-type", options.temperature_type)->check(CLI::IsMember({"int16", "real32"}));
  app.add_option("--temperature-unit_C", drive.temperature.unit_C, "of one count of an int16");
  app.add_option("--initial-position_rad", drive.plant.initial_position_rad, "at the start");
  app.add_option("--inertia_kgm2", drive.plant.joint.inertia_kgm2, "at the joint");
  app.add_option("--period_s", options.period_s, "the drive's control period");
}

void finish(const Options& options, Cia402NodeConfig& config) {
  ServoDriveConfig& drive = config.drive;
  config.node_id = static_cast<std::uint8_t>(options.node_id);
  drive.joint_torque_per_drive_torque =
      (options.torque_side == "motor" ? options.gear_ratio : 1.0) * (options.reversed ? -1.0 : 1.0);
  drive.plant.period_s = options.period_s;
  drive.ambient = TemperatureProfile::parse(options.ambient);
  drive.has_cst = std::find(options.modes.begin(), options.modes.end(), "cst") != options.modes.end();
  drive.has_tq = std::find(options.modes.begin(), options.modes.end(), "tq") != options.modes.end();
  if (options.temperature_type == "real32") drive.temperature.type = DataType::kReal32;
  if (options.temperature_object.size() == 2)
    drive.temperature.key = {static_cast<std::uint16_t>(options.temperature_object[0]),
                             static_cast<std::uint8_t>(options.temperature_object[1])};
}

int run(int argc, char** argv) {
  CLI::App app("A simulated CiA 402 servo drive with a joint behind it.", "cia402-node");
  Options options;
  Cia402NodeConfig config;
  // The bus brings the period of delay that the plant has elsewhere: what is read was sampled with the last SYNC.
  config.drive.plant = realistic_plant();
  config.drive.plant.delay.periods = 0.0;
  add_options(app, options, config);
  CLI11_PARSE(app, argc, argv);
  finish(options, config);
  // Network management, SYNC, heartbeats, and of the predefined connection set what has this node's number.
  CanPort port(options.interface, {{0x000}, {0x080}, {0x700, 0x780}, {config.node_id, 0x07F}});
  BusAndRecord output(port);
  Cia402Node node(config, output);
  return run_node(node, port, output, options.control);
}

}  // namespace
}  // namespace strainwave::can_nodes

int main(int argc, char** argv) {
  try {
    return strainwave::can_nodes::run(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "cia402-node: %s\n", error.what());
    return 1;
  }
}
