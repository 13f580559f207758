// SPDX-License-Identifier: BSD-3-Clause
// The subcommands of strainwave-sim. Each adds itself to the program. The one that the user gives leaves its
// action in `chosen`; the action throws InputError. Offline.
#pragma once

#include <filesystem>
#include <string>

#include "base/manual/command_line.h"
#include "sim/studies/closed_loop.h"
#include "sim/studies/contenders.h"

namespace CLI {
class App;
}

namespace strainwave {

void add_chapter6_command(CLI::App& program, CommandBody& chosen);
void add_run_command(CLI::App& program, CommandBody& chosen);
void add_bound_command(CLI::App& program, CommandBody& chosen);
void add_robustness_command(CLI::App& program, CommandBody& chosen);
void add_heat_command(CLI::App& program, CommandBody& chosen);
void add_flexible_command(CLI::App& program, CommandBody& chosen);
void add_temperature_command(CLI::App& program, CommandBody& chosen);
void add_own_loop_command(CLI::App& program, CommandBody& chosen);
void add_ablation_command(CLI::App& program, CommandBody& chosen);

/// Returns the folder `name` ("data") of the installation, or of the source tree that the program was built
/// from. Throws InputError if neither exists.
std::filesystem::path shared_folder(const std::filesystem::path& name);

/// Adds --tables, the folder of a study's gain tables. tables_folder() returns it, by default the installed one.
void add_tables_option(CLI::App& command, std::string& tables);
std::filesystem::path tables_folder(const std::string& tables);

/// Joints that a study draws at random.
struct RandomJoints {
  int count;
  std::uint64_t seed = 1;
};
/// Adds --joints and --seed.
void add_random_joints_options(CLI::App& command, RandomJoints& joints, const std::string& number_of);

/// The elements of a single closed loop, as the user gives them.
struct LoopOptions {
  std::string plant = "realistic";
  std::string reference_rad = "constant:0.1";
  std::string ambient_temperature_C = "constant:20";
  std::string load_torque_Nm = "constant:0";
  double duration_s = 2.0;
};

/// Adds --plant, --reference_rad, --ambient-temperature_C, --load-torque_Nm and --duration_s.
void add_loop_options(CLI::App& command, LoopOptions& options);
/// Throws InputError.
ClosedLoopConfig loop_config(const LoopOptions& options);

/// "extended" (as the daemon runs it) or "plain" (the bare law) with `table`, or "pid". Throws InputError for
/// another kind.
Contender contender_of_kind(const std::string& kind, const GainTable& table);

}  // namespace strainwave
