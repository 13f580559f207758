#include "client/command_line.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <functional>
#include <memory>
#include <string>

#include "client/commands.h"
#include "client/text.h"
#include "control/input_error.h"

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

/// What the command line asks for.
struct Invocation {
  std::string lcm_url = "udpm://239.255.76.67:7667?ttl=0";
  ClientOptions options;
  std::function<void(Client&, const Output&)> command;
  std::function<void(const Output&)> local_command;  ///< instead of `command`: needs neither LCM nor a daemon
};

CLI::Validator name_validator() {
  return {[](const std::string& name) {
            return is_valid_name(name)
                       ? std::string()
                       : "'" + name + "' is not a name: 1 to 24 of A-Z a-z 0-9 _ and - are allowed";
          },
          ""};
}

CLI::Validator seconds_validator() {
  return {[](const std::string& text) {
            double seconds = 0.0;
            const bool good =
                CLI::detail::lexical_cast(text, seconds) && seconds > 0.0 && std::isfinite(seconds);
            return good ? std::string() : "'" + text + "' is not a time: give a number of seconds above 0";
          },
          ""};
}

CLI::Option* add_seconds(CLI::App& app, const std::string& name, double& value, const std::string& help) {
  return app.add_option(name, value, help)->check(seconds_validator())->type_name("SECONDS");
}

/// A command on exactly one joint, without more arguments.
void add_order(CLI::App& app, Invocation& invocation, const std::string& name, const std::string& help,
               void (*order)(Client&, const Output&, const std::string&)) {
  CLI::App* command = app.add_subcommand(name, help);
  auto joint = std::make_shared<std::string>();
  command->add_option("JOINT", *joint, "joint")->required()->check(name_validator())->type_name("");
  command->callback([&invocation, joint, order] {
    invocation.command = [joint, order](Client& client, const Output& output) {
      order(client, output, *joint);
    };
  });
}

void add_status(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("status", "what every joint does now, or every field of one joint");
  auto joint = std::make_shared<std::string>();
  auto json = std::make_shared<bool>(false);
  command->add_option("JOINT", *joint, "joint")->check(name_validator())->type_name("");
  command->add_flag("--json", *json, "as JSON, for scripts");
  command->callback([&invocation, joint, json] {
    invocation.command = [joint, json](Client& client, const Output& output) {
      show_status(client, output, {joint->empty() ? std::nullopt : std::optional(*joint), *json});
    };
  });
  app.add_subcommand("timing", "real time or not, overruns, worst latencies, refused messages")
      ->callback([&invocation] { invocation.command = show_timing; });
}

void add_watch(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("watch", "joints over time, until Ctrl-C");
  auto arguments = std::make_shared<WatchArguments>();
  command->add_option("JOINT", arguments->joints, "joints; none: all")
      ->check(name_validator())
      ->type_name("");
  add_seconds(*command, "--interval_s", arguments->interval_s, "time between two lines")
      ->capture_default_str();
  auto duration_s = std::make_shared<double>(0.0);
  add_seconds(*command, "--duration_s", *duration_s, "end after this time");
  command->add_flag("--plain", arguments->plain, "a new line each time, nothing rewritten in place");
  command->callback([&invocation, arguments, duration_s] {
    if (*duration_s > 0.0) arguments->duration_s = *duration_s;
    invocation.command = [arguments](Client& client, const Output& output) {
      watch(client, output, *arguments);
    };
  });
}

void add_record(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("record", "received states to a CSV file, until Ctrl-C");
  auto arguments = std::make_shared<RecordArguments>();
  command->add_option("JOINT", arguments->joints, "joints")
      ->required()
      ->check(name_validator())
      ->type_name("");
  command->add_option("--out", arguments->file, "the CSV file")->required()->type_name("FILE");
  auto duration_s = std::make_shared<double>(0.0);
  add_seconds(*command, "--duration_s", *duration_s, "end after this time");
  command->add_flag("--overwrite", arguments->overwrite, "replace the file if it exists");
  command->callback([&invocation, arguments, duration_s] {
    if (*duration_s > 0.0) arguments->duration_s = *duration_s;
    invocation.command = [arguments](Client& client, const Output& output) {
      record(client, output, *arguments);
    };
  });
}

void add_move(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("move", "move one joint to a position");
  auto arguments = std::make_shared<MoveArguments>();
  auto position = std::make_shared<std::string>();
  command->add_option("JOINT", arguments->joint, "joint")->required()->check(name_validator())->type_name("");
  command->add_option("POSITION_rad", *position, "where to, in rad, joint side")->required()->type_name("");
  command->add_flag("--wait", arguments->wait, "return once the joint holds there");
  command->callback([&invocation, arguments, position] {
    arguments->position_rad = parse_position_rad(*position);
    invocation.command = [arguments](Client& client, const Output& output) {
      move(client, output, *arguments);
    };
  });
}

void add_load_table(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("load-table", "offer a gain table to one joint, or to all");
  auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("[JOINT] FILE", *words, "the table as JSON; without a joint it is for all")
      ->required()
      ->expected(1, 2)
      ->type_name("");
  command->callback([&invocation, words] {
    auto arguments = std::make_shared<LoadTableArguments>();
    arguments->file = words->back();
    if (words->size() == 2) {
      if (!is_valid_name(words->front())) {
        throw ClientError(ExitStatus::kUsage,
                          "load-table [JOINT] FILE: '" + words->front() + "' is not a joint's name");
      }
      arguments->joint = words->front();
    }
    invocation.command = [arguments](Client& client, const Output& output) {
      load_table(client, output, *arguments);
    };
  });
}

void add_keygen(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("keygen", "a new key to sign orders with");
  auto arguments = std::make_shared<KeygenArguments>();
  auto role = std::make_shared<std::string>(to_text(Role::kOperator));
  command->add_option("--out", arguments->out, "the secret key; its public line goes to FILE.pub")
      ->required()
      ->type_name("FILE");
  command->add_option("--role", *role, "operator: setpoints and commands; engineer: also gain tables")
      ->check(CLI::IsMember({"operator", "engineer"}))
      ->capture_default_str();
  command->add_option("--comment", arguments->comment, "whose key it is; otherwise user@host");
  command->callback([&invocation, arguments, role] {
    arguments->role = *parse_role(*role);
    invocation.local_command = [arguments](const Output& output) { keygen(output, *arguments); };
  });
}

void add_can(CLI::App& app, Invocation& invocation) {
  CLI::App* scan = app.add_subcommand("can-scan", "who is on a CAN bus: reads only (no daemon)");
  auto interface_name = std::make_shared<std::string>();
  scan->add_option("IFACE", *interface_name, "CAN interface, such as can0")->required()->type_name("");
  scan->callback([&invocation, interface_name] {
    invocation.local_command = [interface_name](const Output& output) { can_scan(output, *interface_name); };
  });
  CLI::App* check = app.add_subcommand("can-check", "do to the drives all that start-up does, enable none (no daemon)");
  auto config = std::make_shared<std::filesystem::path>();
  check->add_option("CONFIG", *config, "the daemon's configuration file")->required()->type_name("");
  check->callback([&invocation, config] {
    invocation.local_command = [config](const Output& output) { can_check(output, *config); };
  });
}

void add_plot_record(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("plot-record", "draw a flight record into a PNG (needs gnuplot, no daemon)");
  auto arguments = std::make_shared<PlotRecordArguments>();
  auto around_s = std::make_shared<double>(0.0);
  command->add_option("FILE", arguments->file, "the record")->required()->type_name("");
  command->add_option("--out", arguments->out, "the picture; otherwise FILE.png")->type_name("PNG");
  add_seconds(*command, "--around_s", *around_s, "draw only so much before and after the fault");
  command->callback([&invocation, arguments, around_s] {
    if (*around_s > 0.0) arguments->around_s = *around_s;
    invocation.local_command = [arguments](const Output& output) { plot_record(output, *arguments); };
  });
}

void configure(CLI::App& app, Invocation& invocation) {
  app.set_version_flag("--version", std::string("strainwavectl ") + STRAINWAVE_VERSION);
  app.require_subcommand(1);
  app.fallthrough();
  app.footer(kExitStatuses);
  app.add_option("--lcm-url", invocation.lcm_url, "the LCM network")
      ->envname("LCM_DEFAULT_URL")
      ->capture_default_str()
      ->type_name("URL");
  app.add_option("--prefix", invocation.options.prefix, "first part of the daemon's channels")
      ->check(name_validator())
      ->capture_default_str()
      ->type_name("NAME");
  app.add_option("--key", invocation.options.key_file, "the secret key to sign orders with (see keygen)")
      ->envname("STRAINWAVE_KEY")
      ->type_name("FILE");
  add_seconds(app, "--timeout_s", invocation.options.timeout_s,
              "longest wait for a state, an answer or a change of mode")
      ->capture_default_str();
  add_status(app, invocation);
  add_watch(app, invocation);
  add_order(app, invocation, "enable", "switch the drive on and hold the position", enable);
  add_order(app, invocation, "disable", "stop and switch the drive off", disable);
  add_move(app, invocation);
  add_order(app, invocation, "hold", "stop and hold where it stops", hold);
  add_order(app, invocation, "clear-fault", "leave a latched fault, to off", clear_fault);
  add_load_table(app, invocation);
  add_record(app, invocation);
  add_plot_record(app, invocation);
  add_keygen(app, invocation);
  add_can(app, invocation);
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
