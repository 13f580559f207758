// What the command lines of all programs have in common: version, manual, exit statuses, and the words of their errors.
// Not real-time.
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "base/exit_status.h"
#include "base/manual/manual.h"

namespace CLI {
class App;
}

namespace strainwave {

/// Gives `app` its name, --version, the hidden --manual, and the exit statuses below its help. `app` must outlive the parse.
void configure_program(CLI::App& app, const Manual& manual);

/// Parses the words after the program's name ("-.5" counts as "-0.5"). Nothing: go on. Otherwise the program ends: help and
/// version on `out`, or on `err` one line "program: what was given, what is allowed, the nearest right word".
std::optional<ExitStatus> parse_command_line(CLI::App& app, std::vector<std::string> words, std::ostream& out,
                                             std::ostream& err);

/// What a subcommand does. The parser leaves it with the program when the subcommand is given; nothing runs inside the parser.
using CommandBody = std::function<ExitStatus()>;

/// Parses, then calls `action` and says on `err` why it threw: a ProgramError has its status, NotAchieved is kRefused, InputError and a
/// file that cannot be had are kUsage, anything else kNoAnswer.
ExitStatus run_program(CLI::App& app, int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                       const CommandBody& action);
/// On the standard streams, as what main() returns.
int run_program(CLI::App& app, int argc, const char* const* argv, const CommandBody& action);

}  // namespace strainwave
