#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "control/gain_table_json.h"
#include "sim/commands/commands.h"
#include "sim/studies/scenarios.h"
#include "sim/studies/text_table.h"
#include "sim/studies/time_optimal.h"

namespace strainwave {

namespace {

struct Options {
  LoopOptions loop;
  std::string table;
};

void add_row(TextTable& result, const std::string& reference, const ClosedLoopConfig& config,
             const std::vector<Contender>& contenders) {
  const TimeOptimalResult limit = run_time_optimal(config);
  std::vector<std::string> row = {reference, number(1e3 * limit.first_arrival_s),
                                  number(limit.statistics.pi2), number(limit.statistics.pi1_rad2)};
  for (const Contender& contender : contenders) {
    const ClosedLoopResult closed = run_closed_loop(config, *contender.make(config.plant));
    row.push_back(number(closed.statistics.pi2));
    row.push_back(number(closed.statistics.pi2 / limit.statistics.pi2, 3));
  }
  result.rows.push_back(row);
}

void run(const Options& options, bool one_reference) {
  std::vector<Contender> contenders = {pid_contender()};
  if (!options.table.empty()) {
    const GainTable table = read_gain_table(options.table);
    for (const char* kind : {"fallback", "plain", "extended"})
      contenders.push_back(contender_of_kind(kind, table));
  }
  TextTable result;
  result.title =
      "Time-optimal motion, plant " + options.loop.plant + ", temperature " + options.loop.temperature;
  result.header = {"reference", "first arrival (ms)", "PI2", "PI1 (rad^2)"};
  for (const Contender& contender : contenders) {
    result.header.push_back(contender.name + " PI2");
    result.header.push_back("x limit");
  }
  ClosedLoopConfig config = loop_config(options.loop);
  if (one_reference) {
    add_row(result, options.loop.reference, config, contenders);
  } else {
    for (const double start_rad : kRangeStart_rad) {
      config.setpoint_rad = TimeProfile::constant(start_rad, {"setpoint_position_rad"});
      add_row(result, "constant:" + number(start_rad), config, contenders);
    }
  }
  std::cout << result.markdown();
}

}  // namespace

void add_bound_command(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  options->loop.plant = "limited";
  options->loop.temperature = "constant:-10";
  CLI::App* command = program.add_subcommand(
      "bound", "The physical limit: time-optimal motion of the same plant, and controllers as ratios to it");
  command->add_option("--table", options->table, "gain table (JSON) to compare; the PID is always compared");
  add_loop_options(*command, options->loop);
  command->get_option("--reference")->default_str("constant: 0.001, 0.01, 0.1 and 1 rad in turn");
  command->callback([options, command] { run(*options, command->get_option("--reference")->count() > 0); });
}

}  // namespace strainwave
