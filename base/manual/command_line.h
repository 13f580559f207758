// SPDX-License-Identifier: BSD-3-Clause
// What the command lines of all programs have in common: version, manual, exit statuses, and the words of their errors.
// Not real-time.
#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "base/manual/manual.h"
#include "strainwave/exit_status.h"

namespace CLI {
class App;
}

namespace strainwave {

/// Gives `app` its name, --version, the hidden --manual, and the exit statuses below its help. `app` must outlive the parse.
void configure_program(CLI::App& app, const Manual& manual);

/// What a subcommand does. The parser leaves it with the program when the subcommand is given; nothing runs inside the parser.
using CommandBody = std::function<ExitStatus()>;

/// Why a program ends: its status, the sentence for the user, and what was thrown.
struct ProgramFailure {
  ExitStatus status;
  std::string why;
  const std::exception& error;
};
using FailureTeller = std::function<void(const ProgramFailure&)>;

/// Parses the words after the program's name ("-.5" counts as "-0.5"): help and version go to `out`, and a ProgramError says what was
/// given, what is allowed, the nearest right word. Then calls `action`. `tell` is called with what was thrown: a ProgramError has its
/// status, NotAchieved is kRefused, InputError and a file that cannot be had are kUsage, anything else kNoAnswer.
ExitStatus run_program(CLI::App& app, int argc, const char* const* argv, std::ostream& out,
                       const FailureTeller& tell, const CommandBody& action);
/// One line "program: why" on `err`, as programs usually tell it.
void tell_failure(const CLI::App& app, std::ostream& err, const ProgramFailure& failure);
/// On the standard streams, as what main() returns.
int run_program(CLI::App& app, int argc, const char* const* argv, const CommandBody& action);

}  // namespace strainwave
