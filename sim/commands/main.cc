// strainwave-sim: the closed loop without real time. See `strainwave-sim --help`.
#include <CLI/CLI.hpp>
#include <system_error>

#include "base/input_error.h"
#include "base/manual/command_line.h"
#include "sim/commands/commands.h"

namespace strainwave {

std::filesystem::path shared_folder(const std::filesystem::path& name) {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error);
  const auto installed = program.parent_path().parent_path() / "share" / "strainwave" / name;
  if (!error && std::filesystem::is_directory(installed)) return installed;
  // A package knows of no source tree.
  const std::filesystem::path tree(STRAINWAVE_SOURCE_DIR);
  if (!tree.empty() && std::filesystem::is_directory(tree / name)) return tree / name;
  throw InputError("the folder '" + name.string() + "' is not at " + installed.string() +
                   (tree.empty() ? "" : ", nor at " + (tree / name).string()) + "; say where it is");
}

}  // namespace strainwave

int main(int argc, char** argv) {
  CLI::App program("Simulates a strain-wave joint under control, faster than real time.");
  strainwave::configure_program(program, "strainwave-sim");
  program.require_subcommand(1);
  strainwave::add_chapter6_command(program);
  strainwave::add_run_command(program);
  strainwave::add_bound_command(program);
  strainwave::add_robustness_command(program);
  strainwave::add_heat_command(program);
  strainwave::add_flexible_command(program);
  // Each command runs in its callback, as part of the parse.
  return strainwave::run_program(program, argc, argv, [] { return strainwave::ExitStatus::kDone; });
}
