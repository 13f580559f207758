#include "client/options/command_line.h"

#include <CLI/CLI.hpp>
#include <string>

#include "base/input_error.h"
#include "base/manual/manual.h"
#include "client/options/command_options.h"

namespace strainwave {

namespace {

constexpr const char* kExitStatuses =
    "Exit status:\n"
    "  0  done\n"
    "  1  refused by the daemon, or ended by a fault or another order; the reason is printed\n"
    "  2  the command line makes no sense\n"
    "  3  no daemon, no such joint, or no acknowledgement in time\n"
    "  4  a file cannot be read or written, or its content is wrong\n"
    "  5  LCM is not available on this PC\n"
    "  130  interrupted while waiting\n";

void configure(CLI::App& app, Invocation& invocation) {
  app.set_version_flag("--version", std::string("strainwavectl ") + STRAINWAVE_VERSION);
  add_manual_option(app, "strainwavectl");
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(kExitStatuses);
  add_common_options(app, invocation);
  add_observing_commands(app, invocation);
  add_order_commands(app, invocation);
  add_identify_command(app, invocation);
  add_log_commands(app, invocation);
  add_key_commands(app, invocation);
  add_hardware_commands(app, invocation);
}

/// The arguments as CLI11 takes them: last first, and "-.5" as "-0.5", which it would take for an option.
std::vector<std::string> reversed_arguments(int argc, const char* const* argv) {
  std::vector<std::string> arguments;
  for (int i = argc - 1; i > 0; --i) {
    std::string argument = argv[i];
    if (argument.starts_with("-.")) argument.insert(1, "0");
    arguments.push_back(std::move(argument));
  }
  return arguments;
}

/// CLI11's error in its own words, except for the one it does not name: a command that does not exist.
ExitStatus report_parse_error(const CLI::App& app, const CLI::ParseError& error, std::ostream& out,
                              std::ostream& err) {
  if (error.get_exit_code() == 0) {
    app.exit(error, out, err);
    return ExitStatus::kDone;
  }
  const std::vector<std::string> unknown = app.remaining();
  if (app.get_subcommands().empty() && !unknown.empty()) {
    err << "strainwavectl: '" << unknown.front() << "' is not a command; see strainwavectl --help\n";
  } else {
    err << "strainwavectl: " << error.what() << "; see strainwavectl --help\n";
  }
  return ExitStatus::kUsage;
}

ExitStatus report(std::ostream& err, ExitStatus status, const std::string& message) {
  err << "strainwavectl: " << message << '\n';
  return status;
}

}  // namespace

ExitStatus run_command_line(int argc, const char* const* argv, std::ostream& out, std::ostream& err,
                            bool terminal) {
  CLI::App app{"Commands and observes the joints of strainwaved over LCM.", "strainwavectl"};
  Invocation invocation;
  try {
    configure(app, invocation);
    app.parse(reversed_arguments(argc, argv));
    if (invocation.local_command) {
      invocation.local_command({out, terminal});
      return ExitStatus::kDone;
    }
    Connection connection(invocation.lcm_url);
    Client client(connection, invocation.options);
    invocation.command(client, {out, terminal});
    out.flush();
    return ExitStatus::kDone;
  } catch (const CLI::ParseError& error) {
    return report_parse_error(app, error, out, err);
  } catch (const ClientError& error) {
    return report(err, error.status(), error.what());
  } catch (const InputError& error) {
    return report(err, ExitStatus::kFile, error.what());
  } catch (const std::filesystem::filesystem_error& error) {
    return report(err, ExitStatus::kFile, error.what());
  }
}

}  // namespace strainwave
