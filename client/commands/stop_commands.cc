// disable, hold: stops, which wait for no state, and of which it is said that they were sent.
#include <fmt/format.h>

#include <optional>

#include "client/commands/commands.h"
#include "client/commands/order_steps.h"

namespace strainwave {

namespace {

/// Sends a disable or hold, without waiting for a state; that it was sent is said whatever comes of it.
void send_stop(Client& client, const std::string& joint, Action stop) {
  try {
    const Answer answer = client.request_unseen(joint, channel_kind::kCommand, command_message(stop));
    require_accepted(answer, joint, std::string(to_text(stop)));
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kNoAnswer) throw;
    throw ClientError(error.status(), fmt::format("{}: the stop was sent {} times, and nothing answered: {}",
                                                  joint, 1 + PendingOrder::kRepetitions, error.what()));
  }
}

void wait_until_off(Client& client, const Output& output, const std::string& joint) {
  const JointView& view = client.wait_for_joint(joint);
  const auto decided = [&] {
    if (mode_of(view) == Mode::kFaulted) throw faulted(joint, view);
    return mode_of(view) == Mode::kOff;
  };
  if (!client.wait_until(decided, Deadline(client.options().timeout_s))) {
    throw ClientError(ExitStatus::kNoAnswer, fmt::format("{}: accepted, but still {} after {} s", joint,
                                                         to_text(mode_of(view)), client.options().timeout_s));
  }
  say(output, joint + ": disabled", {{"joint", joint}, {"mode", "off"}});
}

}  // namespace

void disable(Client& client, const Output& output, const std::string& joint) {
  send_stop(client, joint, Action::kDisable);
  wait_until_off(client, output, joint);
}

void disable_all(Client& client, const Output& output) {
  std::vector<std::string> stopping;
  std::optional<ClientError> failure;
  const auto attempt = [&](const std::string& joint, const auto& step) {
    try {
      step(joint);
      return true;
    } catch (const ClientError& error) {
      if (error.status() == ExitStatus::kInterrupted) throw;
      failure.emplace(failure ? failure->status() : error.status(),
                      failure ? std::string(failure->what()) + "\n" + error.what() : error.what());
      return false;
    }
  };
  for (const std::string& joint : client.wait_for_joints())
    if (attempt(joint, [&](const std::string& name) { send_stop(client, name, Action::kDisable); }))
      stopping.push_back(joint);
  for (const std::string& joint : stopping)
    attempt(joint, [&](const std::string& name) { wait_until_off(client, output, name); });
  if (failure) throw *failure;
}

void hold(Client& client, const Output& output, const std::string& joint) {
  send_stop(client, joint, Action::kHold);
  say(output, joint + ": holding where it stops", {{"joint", joint}, {"accepted", true}});
}

}  // namespace strainwave
