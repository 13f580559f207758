// SPDX-License-Identifier: BSD-3-Clause
// strainwave-design fits friction, designs gains, verifies and describes tables. It runs on any computer. No
// part of it runs on the robot.
#include <CLI/CLI.hpp>

#include "base/manual/command_line.h"
#include "design/commands.h"

int main(int argc, char** argv) {
  CLI::App app("Fit friction over temperature, design gain tables (LMI), verify and describe them.");
  strainwave::configure_program(
      app, {.program = "strainwave-design",
            .files = {{"/usr/share/strainwave/data/", "the catalogue's friction and tables, to begin with"}},
            .examples = {{"strainwave-design fit no_load_torque.csv --out friction.json",
                          "friction over temperature"},
                         {"strainwave-design gains --friction friction.json --out table.json",
                          "a certified table"},
                         {"strainwave-design verify table.json", "prove it once more"}},
            .see_also = {"strainwaved(8)", "strainwavectl(1)", "strainwave-sim(1)"}});
  app.require_subcommand(1);
  strainwave::CommandBody chosen;
  strainwave::add_fit_command(app, chosen);
  strainwave::add_gains_command(app, chosen);
  strainwave::add_verify_command(app, chosen);
  strainwave::add_show_command(app, chosen);
  return strainwave::run_program(app, argc, argv, [&] { return chosen(); });
}
