// strainwave-sim: the closed loop without real time. See `strainwave-sim --help`.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>
#include <system_error>

#include "base/input_error.h"
#include "base/manual/manual.h"
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
  program.set_version_flag("--version", STRAINWAVE_VERSION);
  program.require_subcommand(1);
  strainwave::add_chapter6_command(program);
  strainwave::add_run_command(program);
  strainwave::add_bound_command(program);
  strainwave::add_robustness_command(program);
  strainwave::add_heat_command(program);
  strainwave::add_manual_option(program, "strainwave-sim");
  try {
    program.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& error) {
    return program.exit(error);
  } catch (const std::exception& error) {
    std::cerr << "strainwave-sim: " << error.what() << '\n';
    return 1;
  }
}
