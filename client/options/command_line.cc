#include "client/options/command_line.h"

#include <CLI/CLI.hpp>
#include <string>

#include "base/manual/command_line.h"
#include "client/options/command_options.h"

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
  add_log_commands(app, invocation);
  add_key_commands(app, invocation);
  add_hardware_commands(app, invocation);
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
  return run_program(app, argc, argv, out, err, [&] {
    run(invocation, {out, terminal, invocation.json});
    out.flush();
    return ExitStatus::kDone;
  });
}

}  // namespace strainwave
