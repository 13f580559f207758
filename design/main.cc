// strainwave-design: fit friction, design gains, verify and describe tables. Runs anywhere; nothing of it
// runs on the robot.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <utility>

#include "base/input_error.h"
#include "base/manual/manual.h"
#include "design/commands.h"

int main(int argc, char** argv) {
  CLI::App app("Fit friction over temperature, design gain tables (LMI), verify and describe them.",
               "strainwave-design");
  app.set_version_flag("--version", std::string(STRAINWAVE_VERSION));
  app.require_subcommand(1);
  std::array<std::pair<CLI::App*, strainwave::Action>, 4> commands;
  commands[0].second = strainwave::add_fit_command(app, commands[0].first);
  commands[1].second = strainwave::add_gains_command(app, commands[1].first);
  commands[2].second = strainwave::add_verify_command(app, commands[2].first);
  commands[3].second = strainwave::add_show_command(app, commands[3].first);
  strainwave::add_manual_option(app, "strainwave-design");
  CLI11_PARSE(app, argc, argv);
  try {
    for (const auto& [command, action] : commands) {
      if (command->parsed()) return action();
    }
  } catch (const strainwave::InputError& error) {
    std::fprintf(stderr, "strainwave-design: %s\n", error.what());
    return 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "strainwave-design: unexpected: %s\n", error.what());
    return 1;
  }
  return 1;
}
