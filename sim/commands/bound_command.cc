// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "control/table/gain_table_json.h"
#include "sim/commands/commands.h"
#include "sim/studies/physical_limit.h"
#include "sim/studies/scenarios.h"
#include "sim/studies/text_table.h"
#include "sim/studies/time_optimal.h"

namespace strainwave {

namespace {

struct BoundOptions {
  LoopOptions loop;
  std::string table;
};

// Adds the row of a flexible joint, which also has the counted sum and the least settling time.
void add_flexible_row(TextTable& result, const std::string& reference, const ClosedLoopConfig& config,
                      const std::vector<Contender>& contenders) {
  const LinkLimitConfig motion = link_limit_of_run(config);
  const LinkLimit limit = find_link_limit(motion);
  const double scale = std::abs(motion.step_rad / config.setpoint_rad.at(0.0));
  std::vector<std::string> row = {reference, number(1e3 * least_settling_time_s(motion, kCountedError_rad)),
                                  number(scale * limit.pi2, 5), number(scale * limit.counted_pi2, 5)};
  for (const Contender& contender : contenders) {
    const ClosedLoopResult closed = run_closed_loop(config, *contender.make(config.plant));
    const double pi2 = evaluate(on_the_link(closed.trace), config.plant.period_s).pi2;
    row.push_back(number(pi2));
    row.push_back(number(pi2 / (scale * limit.pi2), 3));
  }
  result.rows.push_back(row);
}

void add_row(TextTable& result, const std::string& reference, const ClosedLoopConfig& config,
             const std::vector<Contender>& contenders) {
  if (config.plant.effects.transmission) return add_flexible_row(result, reference, config, contenders);
  require_time_optimal_covers(config.plant);
  const TimeOptimalResult limit = run_time_optimal(config);
  std::vector<std::string> row = {reference,
                                  limit.first_arrival_s < 0.0 ? "not in " + number(config.duration_s) + " s"
                                                              : number(1e3 * limit.first_arrival_s),
                                  number(limit.statistics.pi2), number(limit.statistics.pi1_rad2)};
  for (const Contender& contender : contenders) {
    const ClosedLoopResult closed = run_closed_loop(config, *contender.make(config.plant));
    row.push_back(number(closed.statistics.pi2));
    row.push_back(number(closed.statistics.pi2 / limit.statistics.pi2, 3));
  }
  result.rows.push_back(row);
}

void run(const BoundOptions& options, bool one_reference) {
  std::vector<Contender> contenders = {pid_contender()};
  if (!options.table.empty()) {
    const GainTable table = read_gain_table(options.table);
    for (const char* kind : {"plain", "extended"}) contenders.push_back(contender_of_kind(kind, table));
  }
  ClosedLoopConfig config = loop_config(options.loop);
  const bool flexible = config.plant.effects.transmission.has_value();
  TextTable result;
  result.title =
      std::string(flexible ? "Least error of the link" : "Time-optimal motion of the rigid joint") +
      ", plant " + options.loop.plant + ", surroundings " + options.loop.ambient_temperature_C;
  result.header = flexible
                      ? std::vector<std::string>{"reference", "settled within 40 urad (ms)",
                                                 "PI2 of the link", "counting |e| > 40 urad"}
                      : std::vector<std::string>{"reference", "first arrival (ms)", "PI2", "PI1 (rad^2)"};
  for (const Contender& contender : contenders) {
    result.header.push_back(contender.name + " PI2");
    result.header.push_back("x limit");
  }
  if (one_reference) {
    add_row(result, options.loop.reference_rad, config, contenders);
  } else {
    for (const double start_rad : kRangeStart_rad) {
      config.setpoint_rad = TimeProfile::constant(start_rad, {"setpoint_position_rad"});
      add_row(result, "constant:" + number(start_rad), config, contenders);
    }
  }
  std::cout << result.markdown();
}

}  // namespace

void add_bound_command(CLI::App& program, CommandBody& chosen) {
  const auto options = std::make_shared<BoundOptions>();
  options->loop.plant = "limited";
  options->loop.ambient_temperature_C = "constant:-10";
  CLI::App* command = program.add_subcommand("bound",
                                             "The physical limit: the best motion of the same plant (of a "
                                             "flexible one, its link), and controllers as ratios to it");
  command->add_option("--table", options->table, "gain table (JSON) to compare; the PID is always compared");
  add_loop_options(*command, options->loop);
  command->get_option("--reference_rad")->default_str("constant: 0.001, 0.01, 0.1 and 1 rad in turn");
  command->callback([&chosen, options, command] {
    chosen = [options, one_reference = command->get_option("--reference_rad")->count() > 0] {
      run(*options, one_reference);
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
