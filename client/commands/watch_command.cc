// SPDX-License-Identifier: BSD-3-Clause
// watch: shows joints over time, as a full screen or as lines.
#include <fmt/format.h>

#include <algorithm>

#include "client/commands/commands.h"
#include "client/text/state_json.h"
#include "client/text/text.h"
#include "client/watch/watch_screen.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

std::vector<JointName> chosen(const Client& client, const std::vector<std::string>& joints) {
  std::vector<JointName> names = client.heard();
  std::erase_if(names, [&](const JointName& name) {
    return !joints.empty() && std::ranges::find(joints, name.joint) == joints.end();
  });
  return names;
}

/// Waits one interval. Returns false when interrupted, which is the normal end of a watch.
bool wait_interval(Client& client, const Deadline& interval) {
  try {
    client.wait_until([] { return false; }, interval);
    return true;
  } catch (const ClientError& error) {
    if (error.status() == ExitStatus::kInterrupted) return false;
    throw;
  }
}

void watch_lines(Client& client, const Output& output, const WatchArguments& arguments) {
  const std::optional<Deadline> end =
      arguments.duration_s ? std::optional<Deadline>(*arguments.duration_s) : std::nullopt;
  const std::size_t columns = name_columns(chosen(client, arguments.joints));
  if (!output.json) output.stream << state_header(columns) << '\n';
  do {
    const std::vector<JointName> names = chosen(client, arguments.joints);
    if (output.json) output.stream << to_json(client.states(), names, -1) << '\n';
    for (const JointName& name : output.json ? std::vector<JointName>{} : names) {
      const JointView& view = *client.states().find(name.prefix, name.joint);
      output.stream << state_row(display_name(name, names), columns, view,
                                 seconds_between(view.received, now()))
                    << '\n';
    }
    output.stream.flush();
  } while (wait_interval(client, Deadline(arguments.interval_s)) && !(end && end->passed()) &&
           output.stream.good());
}

}  // namespace

void watch(Client& client, const Output& output, const WatchArguments& arguments) {
  for (const std::string& joint : arguments.joints) client.wait_for_joint(joint);
  if (arguments.joints.empty()) client.wait_for_heard();
  if (output.terminal && !arguments.plain && !output.json)
    watch_screen(client, arguments);
  else
    watch_lines(client, output, arguments);
}

}  // namespace strainwave
