// strainwave-design: fit friction, design gains, verify and describe tables. Runs anywhere; nothing of it
// runs on the robot.
#include <CLI/CLI.hpp>
#include <array>
#include <utility>

#include "base/manual/command_line.h"
#include "design/commands.h"

int main(int argc, char** argv) {
  CLI::App app("Fit friction over temperature, design gain tables (LMI), verify and describe them.");
  strainwave::configure_program(app, "strainwave-design");
  app.require_subcommand(1);
  std::array<std::pair<CLI::App*, strainwave::CommandBody>, 4> commands;
  commands[0].second = strainwave::add_fit_command(app, commands[0].first);
  commands[1].second = strainwave::add_gains_command(app, commands[1].first);
  commands[2].second = strainwave::add_verify_command(app, commands[2].first);
  commands[3].second = strainwave::add_show_command(app, commands[3].first);
  return strainwave::run_program(app, argc, argv, [&] {
    for (const auto& [command, action] : commands)
      if (command->parsed()) return static_cast<strainwave::ExitStatus>(action());
    return strainwave::ExitStatus::kUsage;
  });
}
