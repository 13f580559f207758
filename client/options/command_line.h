// SPDX-License-Identifier: BSD-3-Clause
// The command line of strainwavectl: turns options and commands into calls of commands.h, and errors into
// exit statuses. Not real-time.
#pragma once

#include <ostream>

#include "strainwave/client_error.h"

namespace strainwave {

/// Runs the command of `argv` and returns the exit status. `terminal`: `out` is a terminal.
ExitStatus run_command_line(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                            bool terminal);

}  // namespace strainwave
