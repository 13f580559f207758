#include "client/options/command_line.h"

#include <CLI/CLI.hpp>
#include <string>

#include "base/input_error.h"
#include "base/manual/command_line.h"
#include "base/printable.h"
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

ExitStatus report(std::ostream& err, ExitStatus status, const std::string& message) {
  err << "strainwavectl: " << printable_paragraph(message) << '\n';
  return status;
}

}  // namespace

ExitStatus run_command_line(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                            bool terminal) {
  CLI::App app{"Commands and observes the joints of strainwaved over LCM.", "strainwavectl"};
  Invocation invocation;
  try {
    configure(app, invocation);
    if (const auto status = parse_command_line(app, {argv + 1, argv + argc}, out, err)) return *status;
    const Output output{out, terminal, invocation.json};
    if (invocation.local_command) {
      invocation.local_command(output);
      return ExitStatus::kDone;
    }
    Connection connection(invocation.lcm_url);
    Client client(connection, invocation.options);
    invocation.command(client, output);
    out.flush();
    return ExitStatus::kDone;
  } catch (const ClientError& error) {
    return report(err, error.status(), error.what());
  } catch (const NotAchieved& error) {
    return report(err, ExitStatus::kRefused, error.what());
  } catch (const InputError& error) {
    return report(err, ExitStatus::kUsage, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return report(err, ExitStatus::kUsage, error.what());
  } catch (const std::exception& error) {
    return report(err, ExitStatus::kNoAnswer, error.what());
  }
}

}  // namespace strainwave
