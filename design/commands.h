// SPDX-License-Identifier: BSD-3-Clause
// The subcommands of strainwave-design. Each adds itself to the program and leaves in `chosen` what is to be done when it is
// given; that throws InputError. Offline.
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
