#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>
#include <memory>

#include "base/text_file.h"
#include "control/gain_table_json.h"
#include "sim/commands/commands.h"
#include "sim/studies/text_table.h"
#include "sim/studies/time_optimal.h"

namespace strainwave {

namespace {

struct Options {
  LoopOptions loop;
  std::string table;
  std::string controller = "extended";
  std::string out;
};

std::string trace_csv(const std::vector<TracePoint>& trace) {
  std::string text =
      "time_s,setpoint_position_rad,joint_position_rad,joint_velocity_rad_s,wanted_torque_Nm,applied_torque_"
      "Nm,"
      "joint_temperature_C\n";
  for (const TracePoint& p : trace) {
    bool first = true;
    for (const double value :
         {p.time_s, p.setpoint_position_rad, p.joint_position_rad, p.joint_velocity_rad_s, p.wanted_torque_Nm,
          p.applied_torque_Nm, p.joint_temperature_C}) {
      text += (first ? "" : ",") + number(value, 10);
      first = false;
    }
    text += '\n';
  }
  return text;
}

TextTable statistics_table(const std::string& controller, const LoopStatistics& s) {
  TextTable table;
  table.header = {"quantity", controller};
  const auto add = [&](const char* name, double value) { table.rows.push_back({name, number(value, 6)}); };
  add("PI1 (rad^2)", s.pi1_rad2);
  add("PI2", s.pi2);
  add("final error (rad)", s.final_error_rad);
  add("largest steady error (rad)", s.steady_error_rad);
  add("overshoot (rad)", s.overshoot_rad);
  add("rise time to 90 % (s)", s.rise_time_s);
  add("settling time to 2 % (s)", s.settling_time_s);
  add("peak torque (N.m)", s.peak_torque_Nm);
  add("torque sign changes per s, steady", s.steady_sign_changes_per_s);
  return table;
}

void run(const Options& options) {
  const ClosedLoopConfig config = loop_config(options.loop);
  const GainTable table = options.table.empty() ? GainTable{} : read_gain_table(options.table);
  const Contender contender = contender_of_kind(options.controller, table);
  const ClosedLoopResult result = run_closed_loop(config, *contender.make(config.plant));
  TextTable statistics = statistics_table(contender.name, result.statistics);
  if (std::isfinite(config.plant.motor.peak_torque_Nm)) {
    const double limit = run_time_optimal(config).statistics.pi2;
    statistics.rows.push_back({"PI2 of the physical limit", number(limit, 6)});
    statistics.rows.push_back({"PI2 over the limit", number(result.statistics.pi2 / limit, 6)});
  }
  std::cout << statistics.markdown();
  if (result.diverged) std::cout << "the loop is unstable: the run ended early\n";
  if (options.out.empty()) return;
  write_text_file(options.out, trace_csv(result.trace));
  std::cout << "every sample written to " << options.out << "\n";
}

}  // namespace

void add_run_command(CLI::App& program) {
  const auto options = std::make_shared<Options>();
  CLI::App* command =
      program.add_subcommand("run", "One closed loop: any table, reference, temperature, plant");
  auto* table = command->add_option("--table", options->table, "gain table (JSON); not needed for the PID");
  auto* kind = command->add_option("--controller", options->controller,
                                   "extended (as the daemon runs it), plain (the bare law), fallback or pid");
  kind->capture_default_str()->check(CLI::IsMember({"extended", "plain", "fallback", "pid"}));
  add_loop_options(*command, options->loop);
  command->add_option("--out", options->out, "CSV file for every sample");
  command->callback([options, table] {
    if (options->controller != "pid" && table->count() == 0) throw CLI::RequiredError("--table");
    run(*options);
  });
}

}  // namespace strainwave
