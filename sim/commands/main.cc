// SPDX-License-Identifier: BSD-3-Clause
// strainwave-sim: the closed loop without real time. See `strainwave-sim --help`.
#include <CLI/CLI.hpp>
#include <system_error>

#include "base/input_error.h"
#include "base/manual/command_line.h"
#include "sim/commands/commands.h"

namespace strainwave {

std::filesystem::path shared_folder(const std::filesystem::path& name) {
  std::error_code error;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  const auto installed = folder.parent_path() / "share" / "strainwave" / name;
  // In a source tree the program is in build/PRESET/bin.
  const auto tree = folder.parent_path().parent_path().parent_path() / name;
  for (const auto& place : {installed, tree})
    if (!error && std::filesystem::is_directory(place)) return place;
  throw InputError("the folder '" + name.string() + "' is neither at " + installed.string() + " nor at " +
                   tree.string() + "; say where it is");
}

}  // namespace strainwave

int main(int argc, char** argv) {
  CLI::App program("Simulates a strain-wave joint under control, faster than real time.");
  strainwave::configure_program(
      program,
      {.program = "strainwave-sim",
       .files = {{"/usr/share/strainwave/data/", "gain tables and friction that the studies begin with"}},
       .examples = {{"strainwave-sim chapter6 --out figures", "every controller through every scenario"},
                    {"strainwave-sim flexible --out figures", "on a gear that is a spring"}},
       .see_also = {"strainwave-design(1)", "strainwaved(8)"}});
  program.require_subcommand(1);
  strainwave::CommandBody chosen;
  strainwave::add_chapter6_command(program, chosen);
  strainwave::add_run_command(program, chosen);
  strainwave::add_bound_command(program, chosen);
  strainwave::add_robustness_command(program, chosen);
  strainwave::add_heat_command(program, chosen);
  strainwave::add_flexible_command(program, chosen);
  strainwave::add_temperature_command(program, chosen);
  strainwave::add_ablation_command(program, chosen);
  strainwave::add_own_loop_command(program, chosen);
  return strainwave::run_program(program, argc, argv, [&] { return chosen(); });
}
