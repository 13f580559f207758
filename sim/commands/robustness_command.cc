// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "base/text_file.h"
#include "control/table/gain_table_json.h"
#include "sim/commands/commands.h"
#include "sim/commands/study_output.h"
#include "sim/joint/plant_file.h"
#include "sim/studies/robustness.h"

namespace strainwave {

namespace {

struct RobustnessOptions {
  RobustnessConfig study;
  std::string table;
  std::string plant = "flexible";
  std::string out = "robustness";
};

void run(RobustnessOptions& options) {
  options.study.plant = plant_named(options.plant);
  const GainTable table = read_gain_table(options.table);
  std::vector<Contender> contenders = {pid_contender()};
  for (const char* kind : {"plain", "extended"}) contenders.push_back(contender_of_kind(kind, table));
  make_folder(options.out);
  const auto draws = run_robustness(options.study, contenders);
  TextTable summary = robustness_summary(draws, contenders);
  summary.title += ", seed " + std::to_string(options.study.seed) + ", setpoint " +
                   number(options.study.setpoint_rad) + " rad, plant " + options.plant;
  write_study("robustness", summary, robustness_table(draws, contenders),
              robustness_figure(draws, contenders), options.out);
}

}  // namespace

void add_robustness_command(CLI::App& program, CommandBody& chosen) {
  const auto options = std::make_shared<RobustnessOptions>();
  CLI::App* command = program.add_subcommand(
      "robustness", "Monte-Carlo: other inertia, friction, payload than the table was made for");
  RobustnessConfig& study = options->study;
  command->add_option("--table", options->table, "gain table (JSON)")->required();
  command
      ->add_option("--plant", options->plant,
                   "nominal plant: flexible, realistic, limited, ideal or a plant file")
      ->capture_default_str();
  command->add_option("--draws", study.draws, "number of joints")->capture_default_str();
  command->add_option("--seed", study.seed, "seed of the draws")->capture_default_str();
  command->add_option("--inertia-spread", study.inertia_spread, "relative, either way")
      ->capture_default_str();
  command->add_option("--friction-spread", study.friction_spread, "relative, either way")
      ->capture_default_str();
  command->add_option("--payload-inertia_kgm2", study.payload_inertia_kgm2, "up to this much more")
      ->capture_default_str();
  command->add_option("--payload-torque_Nm", study.payload_torque_Nm, "load torque up to this, either way")
      ->capture_default_str();
  command->add_option("--setpoint_rad", study.setpoint_rad, "target position")->capture_default_str();
  command->add_option("--duration_s", study.duration_s, "length of a run")->capture_default_str();
  command->add_option("--out", options->out, "folder to write to")->capture_default_str();
  command->callback([&chosen, options] {
    chosen = [options] {
      run(*options);
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
