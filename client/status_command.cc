// status: what every joint does now.
#include "client/commands.h"
#include "client/state_json.h"
#include "client/text.h"

namespace strainwave {

void show_status(Client& client, const Output& output, const StatusArguments& arguments) {
  std::vector<std::string> joints;
  if (arguments.joint) {
    client.wait_for_joint(*arguments.joint);
    joints.push_back(*arguments.joint);
  } else {
    joints = client.wait_for_joints();
  }
  if (arguments.json) {
    output.stream << to_json(client, joints) << '\n';
    return;
  }
  if (!arguments.joint) output.stream << state_header() << '\n';
  for (const std::string& joint : joints) {
    const JointView& view = *client.find(joint);
    const double age_s = seconds_between(view.received, now());
    if (arguments.joint) {
      output.stream << state_details(joint, view, age_s);
    } else {
      output.stream << state_row(joint, view, age_s) << '\n';
    }
  }
}

}  // namespace strainwave
