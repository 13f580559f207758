// SPDX-License-Identifier: BSD-3-Clause
// Common parts of all programs' command lines: version, manual, exit statuses and error messages.
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

/// The action of a subcommand. The parser only hands it to the program, which runs it after the parse.
using CommandBody = std::function<ExitStatus()>;

/// Why a program fails: its exit status, the sentence for the user, and the exception.
struct ProgramFailure {
  ExitStatus status;
  std::string why;
  const std::exception& error;
};
using FailureTeller = std::function<void(const ProgramFailure&)>;

/// Parses the command line ("-.5" counts as "-0.5"), then calls `action`. Help and version go to `out`. A wrong command line becomes a
/// ProgramError with what was given, what is allowed and the nearest valid word. `tell` receives each exception with its status: a
/// ProgramError has its own, NotAchieved gives kRefused, InputError and filesystem_error give kUsage, and any other gives kNoAnswer.
ExitStatus run_program(CLI::App& app, int argc, const char* const* argv, std::ostream& out,
                       const FailureTeller& tell, const CommandBody& action);
/// Writes one line "program: why" to `err`; the usual `tell`.
void tell_failure(const CLI::App& app, std::ostream& err, const ProgramFailure& failure);
/// The same with the standard streams. Returns the value for main() to return.
int run_program(CLI::App& app, int argc, const char* const* argv, const CommandBody& action);

}  // namespace strainwave
