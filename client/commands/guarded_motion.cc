#include "client/commands/guarded_motion.h"

#include <fmt/format.h>

#include <strainwave/command_v1.hpp>

#include "client/commands/commands.h"
#include "client/link/client_error.h"
#include "client/link/interrupt.h"
#include "client/link/orders.h"

namespace strainwave {

namespace {

constexpr double kLongestSilence_s = 0.5;

/// What became of the attempt to hold, in words.
std::string hold_joint(Client& client, const std::string& joint) {
  try {
    command_v1 order{};
    order.action = static_cast<std::int32_t>(Action::kHold);
    const Answer answer = client.request(joint, channel_kind::kCommand, order);
    if (answer.accepted) return joint + " holds where it stops";
    return fmt::format("{} did not take the hold ({})", joint, to_text(answer.reason));
  } catch (const ClientError& error) {
    return fmt::format("{} could not be told to hold ({}); its stream of setpoints expires by itself", joint,
                       error.what());
  }
}

}  // namespace

void run_guarded(Client& client, const std::string& joint, const std::function<void()>& motion) {
  try {
    motion();
  } catch (const ClientError& error) {
    resume_after_interrupt();
    throw error.in_words(fmt::format("{}; {}", error.what(), hold_joint(client, joint)));
  }
}

void require_undisturbed(Client& client, const std::string& joint, std::int64_t session_id) {
  const JointView& view = *client.find(joint);
  const auto fail = [&](ExitStatus status, const std::string& why) {
    throw ClientError(status, joint + ": " + why, {joint, {}, {}, {}, {}});
  };
  if (const auto refusal = client.take_refusal()) require_accepted(*refusal, joint, "a setpoint");
  if (seconds_between(view.received, now()) > kLongestSilence_s)
    fail(ExitStatus::kNoAnswer, fmt::format("nothing heard for {} s", kLongestSilence_s));
  if (view.state.session_id != session_id) fail(ExitStatus::kRefused, "the daemon was restarted");
  const auto mode = static_cast<Mode>(view.state.mode);
  if (mode == Mode::kFaulted) throw faulted(joint, view);
  if (mode != Mode::kHolding && mode != Mode::kTracking) fail(ExitStatus::kRefused, "it was disabled");
}

}  // namespace strainwave
