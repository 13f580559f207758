// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <memory>

#include "base/text_file.h"
#include "control/table/gain_table_json.h"
#include "sim/commands/commands.h"
#include "sim/commands/study_output.h"
#include "sim/joint/plant_file.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/heat.h"

namespace strainwave {

namespace {

struct HeatOptions {
  HeatConfig study;
  std::string table;
  std::string plant = "flexible";
  std::string out = "heat";
};

TextTable details(const std::vector<HeatRun>& runs) {
  TextTable table;
  table.header = {"temperature",        "time_s",       "joint_temperature_C",
                  "told_temperature_C", "pi2_per_move", "settled_error_rad"};
  for (const HeatRun& run : runs)
    for (std::size_t i = 0; i < run.pi2_over_time.size(); ++i)
      table.rows.push_back(
          {run.name, number(run.pi2_over_time[i].first, 9), number(run.joint_temperature_C[i].second, 9),
           number(run.told_temperature_C[i].second, 9), number(run.pi2_over_time[i].second, 9),
           number(run.settled_error_over_time[i].second, 9)});
  return table;
}

void run(HeatOptions& options) {
  options.study.plant = plant_named(options.plant);
  if (options.study.plant.thermal.resistance_C_W == 0.0) options.study.plant.thermal = reference_thermal();
  const GainTable table = read_gain_table(options.table);
  make_folder(options.out);
  const auto runs = run_heat(options.study, table);
  TextTable summary = heat_summary(runs);
  summary.title += ", plant " + options.plant + ", judged at the link";
  write_study("heat", summary, details(runs), heat_figure(runs), options.out);
}

}  // namespace

void add_heat_command(CLI::App& program, CommandBody& chosen) {
  const auto options = std::make_shared<HeatOptions>();
  CLI::App* command = program.add_subcommand(
      "heat", "Losses warm the joint; what a late, biased or missing temperature costs");
  HeatConfig& study = options->study;
  command->add_option("--table", options->table, "gain table (JSON)")->required();
  command->add_option("--plant", options->plant, "flexible, realistic, limited, ideal or a plant file")
      ->capture_default_str();
  command->add_option("--ambient-temperature_C", study.ambient_temperature_C, "surroundings")
      ->capture_default_str();
  command->add_option("--stroke_rad", study.stroke_rad, "there and back")->capture_default_str();
  command->add_option("--interval_s", study.interval_s, "from one setpoint to the next")
      ->capture_default_str();
  command->add_option("--duration_s", study.duration_s, "length of the run")->capture_default_str();
  command->add_option("--sensor-lag_s", study.sensor_lag_s, "time constant of the late sensor")
      ->capture_default_str();
  command->add_option("--bias_C", study.bias_C, "of the biased sensors")->capture_default_str();
  command->add_option("--out", options->out, "folder to write to")->capture_default_str();
  command->callback([&chosen, options] {
    chosen = [options] {
      run(*options);
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
