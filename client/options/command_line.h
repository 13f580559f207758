// SPDX-License-Identifier: BSD-3-Clause
// The command line of strainwavectl: options and commands to calls of commands.h, errors to exit statuses.
// Not real-time.
#pragma once

#include <ostream>

#include "strainwave/client_error.h"

namespace strainwave {

/// Does what `argv` asks and says how it ended. `terminal`: a person looks at `out`.
ExitStatus run_command_line(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                            bool terminal);

}  // namespace strainwave
