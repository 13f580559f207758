#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "base/text_file.h"
#include "sim/commands/commands.h"
#include "sim/studies/ablation.h"

namespace strainwave {

namespace {

struct AblationOptions {
  std::string tables;
  int joints = 300;
  std::uint64_t seed = 1;
};

void run(const AblationOptions& options) {
  const std::filesystem::path directory =
      options.tables.empty() ? shared_folder("data") / "tables" : std::filesystem::path(options.tables);
  const FlexibleTables tables = read_flexible_tables(directory);
  std::vector<AblationRow> rows;
  for (const Mechanism mechanism : kMechanisms) {
    std::cerr << "without: " << name_of(mechanism) << '\n';
    rows.push_back(run_without(mechanism, tables, options.joints, options.seed));
  }
  std::cout << ablation_table(rows).markdown();
}

}  // namespace

void add_ablation_command(CLI::App& program, CommandBody& chosen) {
  const auto options = std::make_shared<AblationOptions>();
  CLI::App* command = program.add_subcommand(
      "ablation", "What each part of the controller is worth: every study with that part switched off");
  command->add_option("--tables", options->tables,
                      "folder with total-*/c1.json .. c4.json (default: the installed tables)");
  command->add_option("--joints", options->joints, "number of random joints")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  command->add_option("--seed", options->seed, "of the random joints")->capture_default_str();
  command->callback([&chosen, options] {
    chosen = [options] {
      run(*options);
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
