// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>

#include "base/input_error.h"
#include "base/printable.h"
#include "sim/commands/commands.h"
#include "sim/joint/plant_file.h"

namespace strainwave {

void add_tables_option(CLI::App& command, std::string& tables) {
  command.add_option("--tables", tables,
                     "folder with total-*/c1.json .. c4.json (default: the installed tables)");
}

std::filesystem::path tables_folder(const std::string& tables) {
  return tables.empty() ? shared_folder("data") / "tables" : std::filesystem::path(tables);
}

void add_random_joints_options(CLI::App& command, RandomJoints& joints, const std::string& number_of) {
  command.add_option("--joints", joints.count, number_of)
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command.add_option("--seed", joints.seed, "seed of the random joints")->capture_default_str();
}

void add_loop_options(CLI::App& command, LoopOptions& options) {
  command.add_option("--plant", options.plant, "ideal, limited, realistic, flexible, or a plant file (TOML)")
      ->capture_default_str();
  command
      .add_option(
          "--reference_rad", options.reference_rad,
          "setpoint over time: constant:R, steps:START,RISE,INTERVAL_S,COUNT, "
          "ramp:FIRST,SECOND,BEGIN_S,END_S, "
          "square:FIRST,SECOND,INTERVAL_S, csv:FILE or hold:FILE (columns time_s,setpoint_position_rad)")
      ->capture_default_str();
  command
      .add_option("--ambient-temperature_C", options.ambient_temperature_C,
                  "surroundings over time: constant:C, steps:START,RISE,INTERVAL_S,COUNT, "
                  "ramp:FIRST,SECOND,BEGIN_S,END_S, sine:MEAN,AMPLITUDE,RAD_S, csv:FILE or hold:FILE "
                  "(columns time_s,ambient_temperature_C)")
      ->capture_default_str();
  command
      .add_option("--load-torque_Nm", options.load_torque_Nm,
                  "load torque over time, on the link, likewise (column load_torque_Nm); "
                  "steps:0,20,0.5,1 is one step of 20 N.m")
      ->capture_default_str();
  command.add_option("--duration_s", options.duration_s, "length of the run")->capture_default_str();
}

ClosedLoopConfig loop_config(const LoopOptions& options) {
  constexpr double kLongest_s = 1e5;  // the recorded trace fits into memory
  if (!(options.duration_s > 0.0 && options.duration_s <= kLongest_s))
    throw InputError("--duration_s = " + number_text(options.duration_s) +
                     ": a number above 0, at most 100000, is allowed");
  ClosedLoopConfig config;
  config.plant = plant_named(options.plant);
  config.setpoint_rad = TimeProfile::parse(options.reference_rad, {"setpoint_position_rad", -1e5, 1e5});
  config.ambient = TemperatureProfile::parse(options.ambient_temperature_C);
  config.load_torque_Nm = TimeProfile::parse(options.load_torque_Nm, {"load_torque_Nm", -1e4, 1e4});
  config.duration_s = options.duration_s;
  return config;
}

Contender contender_of_kind(const std::string& kind, const GainTable& table) {
  const std::string name(table.primary.controller.view());
  if (kind == "pid") return pid_contender();
  if (kind == "plain") return plain_contender(name, table);
  if (kind == "extended") return extended_contender(name + "+", table);
  throw InputError("--controller", "controller", kind, "must be extended, plain or pid");
}

}  // namespace strainwave
