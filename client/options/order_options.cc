// enable, disable, move, hold, clear-fault, take-over, release, home, load-table, revert-table, inject.
#include <CLI/CLI.hpp>
#include <memory>

#include "client/link/exit_status.h"
#include "client/options/command_options.h"
#include "client/text/text.h"

namespace strainwave {

namespace {

/// A command on exactly one joint, without more arguments.
void add_order(CLI::App& app, Invocation& invocation, const std::string& name, const std::string& help,
               void (*order)(Client&, const Output&, const std::string&)) {
  CLI::App* command = app.add_subcommand(name, help);
  auto joint = std::make_shared<std::string>();
  add_joint(*command, *joint)->required();
  command->callback([&invocation, joint, order] {
    invocation.command = [joint, order](Client& client, const Output& output) {
      order(client, output, *joint);
    };
  });
}

void add_disable(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("disable", "stop and switch the drive off");
  auto joint = std::make_shared<std::string>();
  auto all = std::make_shared<bool>(false);
  CLI::Option* name = add_joint(*command, *joint);
  command->add_flag("--all", *all, "every joint that is heard of the prefix")->excludes(name);
  command->callback([&invocation, joint, all] {
    if (joint->empty() && !*all)
      throw ClientError(ExitStatus::kUsage, "disable: JOINT is required, or --all for every joint");
    invocation.command = [joint, all](Client& client, const Output& output) {
      *all ? disable_all(client, output) : disable(client, output, *joint);
    };
  });
}

void add_move(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("move", "move one joint to a position");
  auto arguments = std::make_shared<MoveArguments>();
  auto position = std::make_shared<std::string>();
  add_joint(*command, arguments->joint)->required();
  command->add_option("POSITION_rad", *position, "where to, in rad, joint side")->required()->type_name("");
  add_positive(*command, "--speed_limit_rad_s", arguments->speed_limit_rad_s, "RAD/S",
               "no faster than this; otherwise as fast as the joint may");
  command->add_flag("--wait", arguments->wait,
                    "return once the joint is there and stays; says how long it took");
  add_positive(*command, "--tolerance_rad", arguments->tolerance_rad, "RAD", "what --wait takes for there")
      ->capture_default_str();
  command->callback([&invocation, arguments, position] {
    arguments->position_rad = parse_position_rad(*position);
    invocation.command = [arguments](Client& client, const Output& output) {
      move(client, output, *arguments);
    };
  });
}

LoadTableArguments load_table_arguments(const std::vector<std::string>& words) {
  LoadTableArguments arguments;
  arguments.file = words.back();
  if (words.size() < 2) return arguments;
  if (!is_valid_name(words.front())) {
    throw ClientError(ExitStatus::kUsage,
                      "load-table [JOINT] FILE: '" + words.front() + "' is not a joint's name");
  }
  arguments.joint = words.front();
  return arguments;
}

void add_load_table(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand("load-table", "offer a gain table to one joint, or to all");
  auto words = std::make_shared<std::vector<std::string>>();
  command->add_option("[JOINT] FILE", *words, "the table as JSON; without a joint it is for all")
      ->required()
      ->expected(1, 2)
      ->type_name("");
  command->callback([&invocation, words] {
    const LoadTableArguments arguments = load_table_arguments(*words);
    invocation.command = [arguments](Client& client, const Output& output) {
      load_table(client, output, arguments);
    };
  });
}

void add_inject(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("inject", "give a simulated drive a fault, for tests (none: end them)");
  auto joint = std::make_shared<std::string>();
  auto kind = std::make_shared<std::string>();
  auto amount = std::make_shared<double>(0.0);
  auto for_s = std::make_shared<double>(0.0);
  add_joint(*command, *joint)->required();
  command->add_option("FAULT", *kind, "sensor_nan, power_lost, ...: see docs/faults.md")
      ->required()
      ->type_name("");
  command->add_option("--amount", *amount, "how much, for the faults that have an amount")
      ->type_name("NUMBER");
  add_seconds(*command, "--for_s", *for_s, "how long; otherwise until ended");
  command->callback([&invocation, joint, kind, amount, for_s] {
    const InjectArguments arguments = parse_injection(*joint, *kind, *amount, *for_s);
    invocation.command = [arguments](Client& client, const Output& output) {
      inject(client, output, arguments);
    };
  });
}

}  // namespace

void add_order_commands(CLI::App& app, Invocation& invocation) {
  add_order(app, invocation, "enable", "switch the drive on and hold the position", enable);
  add_disable(app, invocation);
  add_move(app, invocation);
  add_order(app, invocation, "hold", "stop and hold where it stops", hold);
  add_order(app, invocation, "clear-fault", "leave a latched fault, to off", clear_fault);
  add_order(app, invocation, "take-over", "have the joint instead of whoever has it (engineer)", take_over);
  add_order(app, invocation, "release", "give the joint up before its lease ends", release);
  add_order(app, invocation, "home", "find the home position", home);
  add_load_table(app, invocation);
  add_order(app, invocation, "revert-table", "use the previous gain table again", revert_table);
  add_inject(app, invocation);
}

}  // namespace strainwave
