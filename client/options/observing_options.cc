// SPDX-License-Identifier: BSD-3-Clause
// Options of status, timing, watch.
#include <CLI/CLI.hpp>
#include <memory>

#include "client/options/command_options.h"

namespace strainwave {

namespace {

void add_status(CLI::App& app, Invocation& invocation) {
  CLI::App* command =
      app.add_subcommand("status", "show the state of every joint, or every field of one joint");
  auto joint = std::make_shared<std::string>();
  add_joint(*command, *joint);
  command->callback([&invocation, joint] {
    invocation.command = [joint](Client& client, const Output& output) {
      show_status(client, output, {joint->empty() ? std::nullopt : std::optional(*joint)});
    };
  });
}

void add_timing(CLI::App& app, Invocation& invocation) {
  app.add_subcommand("timing", "show real-time state, overruns, worst latencies and refused messages")
      ->callback([&invocation] { invocation.command = show_timing; });
}

void add_watch(CLI::App& app, Invocation& invocation) {
  CLI::App* command = app.add_subcommand(
      "watch", "watch joints on a full screen; keys stop, enable, hold, clear and jog; ? explains, q quits");
  auto arguments = std::make_shared<WatchArguments>();
  add_joints(*command, arguments->joints, "joints; none: all");
  add_seconds(*command, "--interval_s", arguments->interval_s,
              "time between two lines, or two points of the sparklines")
      ->capture_default_str();
  auto duration_s = std::make_shared<double>(0.0);
  add_seconds(*command, "--duration_s", *duration_s, "end after this time");
  command->add_flag("--plain", arguments->plain,
                    "lines instead of a full screen, as when standard output is no terminal");
  command->callback([&invocation, arguments, duration_s] {
    if (*duration_s > 0.0) arguments->duration_s = *duration_s;
    invocation.command = [arguments](Client& client, const Output& output) {
      watch(client, output, *arguments);
    };
  });
}

}  // namespace

void add_observing_commands(CLI::App& app, Invocation& invocation) {
  add_status(app, invocation);
  add_timing(app, invocation);
  add_watch(app, invocation);
}

}  // namespace strainwave
