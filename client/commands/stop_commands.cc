// SPDX-License-Identifier: BSD-3-Clause
// disable, hold: stop joints.
#include "client/commands/commands.h"
#include "client/commands/each_joint.h"
#include "client/protocol/orders.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

void say_disabled(const Output& output, const std::string& joint) {
  say(output, joint + ": disabled", {{"joint", joint}, {"mode", "off"}});
}

// A stop needs the name of a joint. Without names it goes to the joints heard. A named joint gets it even if unheard.
std::vector<std::string> joints_to_stop(Client& client, const std::vector<std::string>& joints) {
  try {
    return joints_or_all(client, joints);
  } catch (const NoAnswer& error) {
    throw NoAnswer(std::string(error.what()) +
                   " NO STOP WAS SENT, because no joint publishes its state. To send a stop in any case, "
                   "name the joint: strainwavectl disable JOINT");
  }
}

}  // namespace

void disable(Client& client, const Output& output, const std::vector<std::string>& joints) {
  Failures failures;
  std::vector<std::string> stopping;
  for (const std::string& joint : joints_to_stop(client, joints))
    if (failures.attempt(joint, [&] { send_stop(client, joint, Action::kDisable); }))
      stopping.push_back(joint);
  for (const std::string& joint : stopping)
    if (failures.attempt(joint, [&] { wait_until_off(client, joint); })) say_disabled(output, joint);
  failures.rethrow();
}

void hold(Client& client, const Output& output, const std::string& joint) {
  send_stop(client, joint, Action::kHold);
  say(output, joint + ": holding where it stops", {{"joint", joint}, {"accepted", true}});
}

}  // namespace strainwave
