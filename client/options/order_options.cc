// SPDX-License-Identifier: BSD-3-Clause
// enable, disable, move, path, pause, resume, hold, clear-fault, take-over, release, home, load-table, revert-table, friction, inject.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <memory>

#include "client/options/command_options.h"
#include "client/text/text.h"
#include "strainwave/client_error.h"

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

using EachOrder = std::function<void(Client&, const Output&, const std::vector<std::string>&)>;

/// A command for one or several joints, or with --all for every joint heard.
void add_order_to_each(CLI::App& app, Invocation& invocation, const std::string& name,
                       const std::string& help, const EachOrder& order) {
  CLI::App* command = app.add_subcommand(name, help);
  auto joints = std::make_shared<std::vector<std::string>>();
  auto all = std::make_shared<bool>(false);
  CLI::Option* names = add_joints(*command, *joints, "joints, one or several");
  command->add_flag("--all", *all, "every joint of the prefix")->excludes(names);
  command->callback([&invocation, name, joints, all, order] {
    if (joints->empty() && !*all) throw InvalidInput(name + ": JOINT is required, or --all for every joint");
    invocation.command = [joints, order](Client& client, const Output& output) {
      order(client, output, *joints);
    };
  });
}

void add_order_to_each(CLI::App& app, Invocation& invocation, const std::string& name,
                       const std::string& help, JointOrder order) {
  add_order_to_each(app, invocation, name, help,
                    [order](Client& client, const Output& output, const std::vector<std::string>& joints) {
                      order_each(client, output, joints, order);
                    });
}

MoveTogetherArguments move_together_arguments(const MoveArguments& first,
                                              const std::vector<std::string>& others) {
  MoveTogetherArguments together{
      {{first.joint, first.position_rad}}, first.wait, first.speed_limit_rad_s, first.tolerance_rad};
  for (std::size_t i = 0; i < others.size(); i += 2) {
    const std::string& joint = others[i];
    if (!is_valid_name(joint)) throw InvalidInput("move: '" + joint + "' is not a joint's name");
    if (i + 1 == others.size())
      throw InvalidInput("move: " + joint + ": each joint needs its position: JOINT POSITION_rad");
    if (std::any_of(together.targets.begin(), together.targets.end(),
                    [&](const JointTarget& target) { return target.joint == joint; }))
      throw InvalidInput("move: " + joint + " is named twice: each joint once is allowed");
    together.targets.push_back({joint, parse_position_rad(others[i + 1])});
  }
  return together;
}

void add_path(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand(
      "path", "follow a path of one or several joints, checked as a whole before it begins");
  auto arguments = std::make_shared<PathArguments>();
  command
      ->add_option("FILE", arguments->file,
                   "CSV: joint, time_s, position_rad, velocity_rad_s; 2 to " +
                       std::to_string(JointPath::kMostKnots) + " knots for each joint")
      ->required()
      ->type_name("");
  command->add_flag(
      "--wait", arguments->wait,
      "return once all joints have reached the end of the path; reports when the path is paused");
  add_positive(*command, "--tolerance_rad", arguments->tolerance_rad, "RAD", "tolerance of --wait")
      ->capture_default_str();
  command->callback([&invocation, arguments] {
    invocation.command = [arguments](Client& client, const Output& output) {
      follow_path(client, output, *arguments);
    };
  });
}

void add_move(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("move", "move a joint to a position, or several that leave and arrive together");
  auto arguments = std::make_shared<MoveArguments>();
  auto position = std::make_shared<std::string>();
  auto others = std::make_shared<std::vector<std::string>>();
  add_joint(*command, arguments->joint)->required();
  command->add_option("POSITION_rad", *position, "target position in rad, joint side")
      ->required()
      ->type_name("");
  command
      ->add_option("JOINT POSITION_rad", *others,
                   "other joints of the daemon, which leave and arrive with this one")
      ->type_name("");
  add_positive(
      *command, "--speed-limit_rad_s", arguments->speed_limit_rad_s, "RAD/S",
      "speed limit of the move; otherwise a quarter of the joint's, or joint.limits.move_speed_share of it");
  command->add_flag("--wait", arguments->wait,
                    "return once the joint has arrived and stays; prints the time");
  add_positive(*command, "--tolerance_rad", arguments->tolerance_rad, "RAD", "tolerance of --wait")
      ->capture_default_str();
  command->callback([&invocation, arguments, position, others] {
    arguments->position_rad = parse_position_rad(*position);
    if (!others->empty()) {
      const MoveTogetherArguments together = move_together_arguments(*arguments, *others);
      invocation.command = [together](Client& client, const Output& output) {
        move_together(client, output, together);
      };
      return;
    }
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

void add_friction(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("friction", "show what a joint has learned of its friction, or reset or freeze it");
  auto joint = std::make_shared<std::string>();
  auto what = std::make_shared<std::string>("show");
  add_joint(*command, *joint)->required();
  command->add_option("WHAT", *what, "show, reset (needs a joint that holds or is off), freeze or resume")
      ->type_name("")
      ->check(CLI::IsMember({"show", "reset", "freeze", "resume"}))
      ->capture_default_str();
  command->callback([&invocation, joint, what] {
    invocation.command = [joint, what](Client& client, const Output& output) {
      if (*what == "show") return show_friction(client, output, *joint);
      order_learning(client, output, *joint,
                     *what == "reset"    ? Action::kResetLearning
                     : *what == "freeze" ? Action::kFreezeLearning
                                         : Action::kResumeLearning);
    };
  });
}

void add_inject(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("inject", "inject a fault into a simulated drive, for tests (none: end all)");
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
  add_seconds(*command, "--for_s", *for_s, "duration; otherwise until ended");
  command->callback([&invocation, joint, kind, amount, for_s] {
    const InjectArguments arguments = parse_injection(*joint, *kind, *amount, *for_s);
    invocation.command = [arguments](Client& client, const Output& output) {
      inject(client, output, arguments);
    };
  });
}

}  // namespace

void add_order_commands(CLI::App& app, Invocation& invocation) {
  add_order_to_each(app, invocation, "enable", "switch the drive on and hold the position", enable);
  add_order_to_each(app, invocation, "disable", "stop and switch the drive off", disable);
  add_move(app, invocation);
  add_path(app, invocation);
  add_order(app, invocation, "pause", "pause the path of this joint, for all joints of the path", pause_path);
  add_order(app, invocation, "resume", "resume the path of this joint, for all joints of the path",
            resume_path);
  add_order_to_each(app, invocation, "hold", "stop and hold where it stops", hold);
  add_order_to_each(app, invocation, "clear-fault", "clear a latched fault; the joint stays off",
                    clear_fault);
  add_order_to_each(app, invocation, "take-over",
                    "become the owner of a joint that another client owns (role engineer)", take_over);
  add_order_to_each(app, invocation, "release", "give the joint up before its lease ends", release);
  add_order_to_each(app, invocation, "home", "find the home position", home);
  add_load_table(app, invocation);
  add_order_to_each(app, invocation, "revert-table", "use the previous gain table again", revert_table);
  add_friction(app, invocation);
  add_inject(app, invocation);
}

}  // namespace strainwave
