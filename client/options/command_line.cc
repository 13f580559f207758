// SPDX-License-Identifier: BSD-3-Clause
#include "client/options/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "base/manual/command_line.h"
#include "client/options/command_options.h"
#include "client/text/failure_json.h"

namespace strainwave {

namespace {

void configure(CLI::App& app, Invocation& invocation) {
  configure_program(app, manual_of_strainwavectl());
  app.require_subcommand(1);
  app.fallthrough();
  add_common_options(app, invocation);
  add_observing_commands(app, invocation);
  add_order_commands(app, invocation);
  add_identify_command(app, invocation);
  add_doctor_command(app, invocation);
  add_log_commands(app, invocation);
  add_key_commands(app, invocation);
  add_hardware_commands(app, invocation);
}

/// The joints that the words of a command name, in any of its forms.
std::vector<std::string> named_joints(const CLI::App& command) {
  const auto words = [&](const char* option) {
    const CLI::Option* const found = command.get_option_no_throw(option);
    return found != nullptr ? found->results() : std::vector<std::string>{};
  };
  std::vector<std::string> joints = words("JOINT");
  if (joints.empty()) joints = words("--joint");
  const std::vector<std::string> others = words("JOINT POSITION_rad");
  for (std::size_t i = 0; i < others.size(); i += 2) joints.push_back(others[i]);
  if (const std::vector<std::string> table = words("[JOINT] FILE"); table.size() > 1)
    joints = {table.front()};
  return joints;
}

/// The command and the joints that `app` has understood.
FailedCommand failed_command(const CLI::App& app) {
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) return {};
  return {chosen.front()->get_name(), named_joints(*chosen.front())};
}

void run(const Invocation& invocation, const Output& output) {
  if (invocation.local_command) return invocation.local_command(output);
  Connection connection(invocation.lcm_url);
  Client client(connection, invocation.options);
  invocation.command(client, output);
}

}  // namespace

ExitStatus run_command_line(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                            bool terminal) {
  CLI::App app{"Commands and observes the joints of strainwaved over LCM.", "strainwavectl"};
  Invocation invocation;
  configure(app, invocation);
  // Searches all words, because the parser may have failed before it reached the option.
  const bool json = std::find(argv + 1, argv + argc, std::string_view("--json")) != argv + argc;
  const auto tell = [&](const ProgramFailure& failure) {
    if (json)
      err << to_json(failure, failed_command(app)) << '\n';
    else
      tell_failure(app, err, failure);
  };
  return run_program(app, argc, argv, out, tell, [&] {
    run(invocation, {out, terminal, invocation.json});
    out.flush();
    return ExitStatus::kDone;
  });
}

}  // namespace strainwave
