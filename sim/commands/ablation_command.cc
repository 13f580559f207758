// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "sim/commands/commands.h"
#include "sim/studies/ablation.h"

namespace strainwave {

namespace {

struct AblationOptions {
  std::string tables;
  RandomJoints joints{300};
};

void run(const AblationOptions& options) {
  const FlexibleTables tables = read_flexible_tables(tables_folder(options.tables));
  std::vector<AblationRow> rows;
  for (const Mechanism mechanism : kMechanisms) {
    std::cerr << "without: " << name_of(mechanism) << '\n';
    rows.push_back(run_without(mechanism, tables, options.joints.count, options.joints.seed));
  }
  std::cout << ablation_table(rows).markdown();
}

}  // namespace

void add_ablation_command(CLI::App& program, CommandBody& chosen) {
  const auto options = std::make_shared<AblationOptions>();
  CLI::App* command = program.add_subcommand(
      "ablation", "What each part of the controller is worth: every study with that part switched off");
  add_tables_option(*command, options->tables);
  add_random_joints_options(*command, options->joints, "number of random joints");
  command->callback([&chosen, options] {
    chosen = [options] {
      run(*options);
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
