// SPDX-License-Identifier: BSD-3-Clause
// enable, clear-fault, take-over, release, revert-table: gives an order and prints its outcome.
#include <fmt/format.h>

#include "client/commands/commands.h"
#include "client/commands/each_joint.h"
#include "client/protocol/orders.h"
#include "client/text/text.h"

namespace strainwave {

void order_each(Client& client, const Output& output, const std::vector<std::string>& joints,
                JointOrder order) {
  Failures failures;
  for (const std::string& joint : joints_or_all(client, joints))
    failures.attempt(joint, [&] { order(client, output, joint); });
  failures.rethrow();
}

void enable(Client& client, const Output& output, const std::string& joint) {
  const bool already = !enable_joint(client, joint);
  const JointView& view = *client.find(joint);
  const std::string mode(to_text(mode_of(view)));
  say(output,
      fmt::format("{}: {}, {} at {:.6f} rad", joint, already ? "enabled already" : "enabled", mode,
                  without_negative_zero(view.state.joint_position_rad, 6)),
      {{"joint", joint},
       {"mode", mode},
       {"position_rad", view.state.joint_position_rad},
       {"already", already}});
}

void clear_fault(Client& client, const Output& output, const std::string& joint) {
  const bool already = !clear_joint_fault(client, joint);
  say(output, already ? joint + ": has no fault" : joint + ": fault cleared; enable it to go on",
      {{"joint", joint}, {"already", already}});
}

void revert_table(Client& client, const Output& output, const std::string& joint) {
  order_accepted(client, joint, Action::kRevertTable);
  say(output, joint + ": the previous table is in use again", {{"joint", joint}, {"accepted", true}});
}

void take_over(Client& client, const Output& output, const std::string& joint) {
  order_accepted(client, joint, Action::kTakeOver);
  say(output, joint + ": taken over; orders of the previous owner are refused from now on",
      {{"joint", joint}, {"accepted", true}});
}

void release(Client& client, const Output& output, const std::string& joint) {
  order_accepted(client, joint, Action::kRelease);
  say(output, joint + ": released; the next client that gives it a command owns it",
      {{"joint", joint}, {"accepted", true}});
}

}  // namespace strainwave
