// SPDX-License-Identifier: BSD-3-Clause
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <memory>

#include "base/input_error.h"
#include "base/text_file.h"
#include "control/table/gain_table_json.h"
#include "sim/commands/commands.h"
#include "sim/studies/physical_limit.h"
#include "sim/studies/text_table.h"

namespace strainwave {

namespace {

struct RunOptions {
  LoopOptions loop;
  std::string table;
  std::string controller = "extended";
  std::string out;
};

std::string trace_csv(const std::vector<TracePoint>& trace) {
  std::string text =
      "time_s,setpoint_position_rad,joint_position_rad,joint_velocity_rad_s,wanted_torque_Nm,applied_torque_"
      "Nm,"
      "joint_temperature_C,link_position_rad\n";
  for (const TracePoint& p : trace) {
    bool first = true;
    for (const double value :
         {p.time_s, p.setpoint_position_rad, p.joint_position_rad, p.joint_velocity_rad_s, p.wanted_torque_Nm,
          p.applied_torque_Nm, p.joint_temperature_C, p.link_position_rad}) {
      text += (first ? "" : ",") + number(value, 10);
      first = false;
    }
    text += '\n';
  }
  return text;
}

/// One column per side of the gear; a rigid joint has one column.
TextTable statistics_table(const std::vector<std::string>& names, const std::vector<LoopStatistics>& sides) {
  TextTable table;
  table.header = {"quantity"};
  table.header.insert(table.header.end(), names.begin(), names.end());
  const auto add = [&](const char* name, double LoopStatistics::*value) {
    table.rows.push_back({name});
    for (const LoopStatistics& side : sides) table.rows.back().push_back(number(side.*value, 6));
  };
  add("PI1 (rad^2)", &LoopStatistics::pi1_rad2);
  add("PI2", &LoopStatistics::pi2);
  add("final error (rad)", &LoopStatistics::final_error_rad);
  add("largest steady error (rad)", &LoopStatistics::steady_error_rad);
  add("overshoot (rad)", &LoopStatistics::overshoot_rad);
  add("rise time to 90 % (s)", &LoopStatistics::rise_time_s);
  add("settling time to 2 % (s)", &LoopStatistics::settling_time_s);
  add("peak torque (N.m)", &LoopStatistics::peak_torque_Nm);
  add("torque sign changes per s, steady", &LoopStatistics::steady_sign_changes_per_s);
  return table;
}

/// Sum |e / r| of the samples with |e| > kCountedError_rad.
double counted_pi2(const std::vector<TracePoint>& trace) {
  double sum = 0.0;
  for (const TracePoint& point : trace) {
    const double error_rad = point.setpoint_position_rad - point.joint_position_rad;
    if (std::abs(error_rad) > kCountedError_rad) sum += std::abs(error_rad / point.setpoint_position_rad);
  }
  return sum;
}

/// Prints the limit of the link if there is one, else of the joint. A plant without a torque limit has none.
void print_limit(const ClosedLoopConfig& config, const LoopStatistics& judged, double counted) {
  if (!std::isfinite(config.plant.motor.peak_torque_Nm)) return;
  const char* of = config.plant.effects.transmission ? " of the link" : "";
  try {
    const PhysicalLimit limit = physical_limit(config);
    std::cout << "PI2" << of << " over the physical limit of " << number(limit.pi2, 6) << ": "
              << number(judged.pi2 / limit.pi2, 6) << "\n";
    if (limit.counted_pi2)
      std::cout << "counting |e| > " << number(1e6 * kCountedError_rad) << " urad, " << number(counted, 6)
                << " over " << number(*limit.counted_pi2, 6) << ": "
                << number(counted / *limit.counted_pi2, 6) << "\n";
  } catch (const InputError& error) {
    std::cout << "no physical limit is known for this run: " << error.what() << "\n";
  }
}

/// Prints the duration of the last move, and the error that remains.
void print_arrival(const std::vector<TracePoint>& link, bool flexible) {
  constexpr double kArcSecond_rad = 4.848137e-6;
  const double target_rad = link.back().setpoint_position_rad;
  const auto error_rad = [&](const TracePoint& point) {
    return std::abs(target_rad - point.link_position_rad);
  };
  const auto same = [&](const TracePoint& point) { return point.setpoint_position_rad == target_rad; };
  const auto begin = std::find_if_not(link.rbegin(), link.rend(), same).base();
  const auto last_off =
      std::find_if(link.rbegin(), std::make_reverse_iterator(begin),
                   [&](const TracePoint& point) { return error_rad(point) > kCountedError_rad; });
  const double left_rad = error_rad(link.back());
  std::cout << "the " << (flexible ? "link" : "joint");
  if (left_rad > kCountedError_rad)
    std::cout << " is not within two counts of an encoder (40 urad) at the end";
  else
    std::cout << " stays within two counts of an encoder (40 urad) after "
              << number(last_off.base() == begin ? 0.0 : std::round(1e3 * (last_off->time_s - begin->time_s)),
                        7)
              << " ms";
  std::cout << " and ends " << number(1e6 * left_rad, 2) << " urad (" << number(left_rad / kArcSecond_rad, 2)
            << " arc seconds) from its target\n";
}

void print_monitor(const ClosedLoopResult& result) {
  if (result.switched_off_s)
    std::cout << "the joint oscillated: the controller switched it off at " << number(*result.switched_off_s)
              << " s\n";
}

void run(const RunOptions& options) {
  const ClosedLoopConfig config = loop_config(options.loop);
  const GainTable table = options.table.empty() ? GainTable{} : read_gain_table(options.table);
  const Contender contender = contender_of_kind(options.controller, table);
  const ClosedLoopResult result = run_closed_loop(config, *contender.make(config.plant));
  const bool flexible = config.plant.effects.transmission.has_value();
  std::vector<std::string> names = {contender.name};
  std::vector<LoopStatistics> sides = {result.statistics};
  const std::vector<TracePoint> link = on_the_link(result.trace);
  if (flexible) {
    names = {contender.name + ", motor", contender.name + ", link"};
    sides.push_back(evaluate(link, config.plant.period_s));
    if (result.diverged) sides.back().pi1_rad2 = sides.back().pi2 = result.statistics.pi2;
  }
  std::cout << statistics_table(names, sides).markdown();
  if (!result.diverged) print_arrival(link, flexible);
  print_limit(config, sides.back(), counted_pi2(link));
  print_monitor(result);
  if (result.diverged) std::cout << "the loop is unstable: the run ended early\n";
  if (options.out.empty()) return;
  write_text_file(options.out, trace_csv(result.trace));
  std::cout << "every sample written to " << options.out << "\n";
}

}  // namespace

void add_run_command(CLI::App& program, CommandBody& chosen) {
  const auto options = std::make_shared<RunOptions>();
  CLI::App* command =
      program.add_subcommand("run", "One closed loop: any table, reference, temperature, plant");
  auto* table = command->add_option("--table", options->table, "gain table (JSON); not needed for the PID");
  auto* kind = command->add_option("--controller", options->controller,
                                   "extended (as the daemon runs it), plain (the bare law) or pid");
  kind->capture_default_str()->check(CLI::IsMember({"extended", "plain", "pid"}));
  add_loop_options(*command, options->loop);
  command->add_option("--out", options->out, "CSV file for every sample");
  command->callback([&chosen, options, table] {
    if (options->controller != "pid" && table->count() == 0) throw CLI::RequiredError("--table");
    chosen = [options] {
      run(*options);
      return ExitStatus::kDone;
    };
  });
}

}  // namespace strainwave
