// SPDX-License-Identifier: BSD-3-Clause
// status: shows the present state of every joint.
#include "client/commands/commands.h"
#include "client/text/state_json.h"
#include "client/text/text.h"

namespace strainwave {

void show_status(Client& client, const Output& output, const StatusArguments& arguments) {
  std::vector<JointName> joints;
  if (arguments.joint) {
    client.wait_for_joint(*arguments.joint);
    joints.push_back({client.options().prefix, *arguments.joint});
  } else {
    joints = client.wait_for_heard();
  }
  if (output.json) {
    output.stream << to_json(client.states(), joints) << '\n';
    return;
  }
  if (!arguments.joint) output.stream << state_header(name_columns(joints)) << '\n';
  for (const JointName& name : joints) {
    const JointView& view = *client.states().find(name.prefix, name.joint);
    const double age_s = seconds_between(view.received, now());
    if (arguments.joint) {
      output.stream << state_details(name.joint, view, age_s);
    } else {
      output.stream << state_row(display_name(name, joints), name_columns(joints), view, age_s) << '\n';
    }
  }
}

}  // namespace strainwave
