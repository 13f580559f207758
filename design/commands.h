// The subcommands of strainwave-design. Each adds itself to the command line and returns what to run when it
// was chosen. Offline.
#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace strainwave {

/// Returns the exit status; throws InputError.
using CommandBody = std::function<int()>;

CommandBody add_fit_command(CLI::App& app, CLI::App*& command);
CommandBody add_gains_command(CLI::App& app, CLI::App*& command);
CommandBody add_verify_command(CLI::App& app, CLI::App*& command);
CommandBody add_show_command(CLI::App& app, CLI::App*& command);

}  // namespace strainwave
