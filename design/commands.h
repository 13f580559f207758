// SPDX-License-Identifier: BSD-3-Clause
// The subcommands of strainwave-design. Each function adds one to the program. If the user gives that
// subcommand, `chosen` receives its body, which may throw InputError. Offline.
#pragma once

#include "base/manual/command_line.h"

namespace CLI {
class App;
}

namespace strainwave {

void add_fit_command(CLI::App& program, CommandBody& chosen);
void add_gains_command(CLI::App& program, CommandBody& chosen);
void add_verify_command(CLI::App& program, CommandBody& chosen);
void add_show_command(CLI::App& program, CommandBody& chosen);

}  // namespace strainwave
