// SPDX-License-Identifier: BSD-3-Clause
#include "client/commands/guarded_motion.h"

#include <fmt/format.h>

#include <strainwave/command_v1.hpp>
#include <utility>

#include "client/commands/commands.h"
#include "client/protocol/interrupt.h"
#include "client/protocol/orders.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

constexpr double kLongestSilence_s = 0.5;

/// Tries to hold the joint, and returns the outcome in words.
std::string hold_joint(Client& client, const std::string& joint) {
  try {
    command_v1 order{};
    order.action = static_cast<std::int32_t>(Action::kHold);
    const Answer answer = client.request(joint, channel_kind::kCommand, order);
    if (answer.accepted) return joint + " holds where it stops";
    return fmt::format("the daemon refused to hold {} ({})", joint, to_text(answer.reason));
  } catch (const ClientError& error) {
    return fmt::format("the hold did not reach {} ({}); its stream of setpoints expires by itself", joint,
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

GuardedJoint::GuardedJoint(Client& client, const std::string& joint, std::string purpose)
    : client_(client),
      joint_(joint),
      purpose_(std::move(purpose)),
      view_(client.wait_for_joint(joint)),
      session_id_(view_.state.session_id) {}

void GuardedJoint::require_undisturbed() {
  check_yield();
  if (const auto refusal = client_.take_refusal()) {
    if (refusal->reason == Reason::kStreamEnded) wait_for_news();
    require_accepted(*refusal, joint_, "a setpoint");
  }
  if (seconds_between(view_.received, now()) > kLongestSilence_s)
    fail(ExitStatus::kNoAnswer, fmt::format("no state for {} s", kLongestSilence_s));
  if (view_.state.session_id != session_id_) fail(ExitStatus::kRefused, "the daemon was restarted");
  const Mode mode = mode_of(view_);
  if (mode == Mode::kFaulted) throw faulted(client_, joint_);
  if (mode != Mode::kHolding && mode != Mode::kTracking) fail(ExitStatus::kRefused, "the joint was disabled");
}

void GuardedJoint::fail(ExitStatus status, const std::string& why) const {
  throw ClientError(status, joint_ + ": " + why, {joint_, {}, {}, {}, {}});
}

void GuardedJoint::check_yield() const {
  if (old_states_ && old_states_->passed() && mode_of(view_) != Mode::kFaulted && has_yielded(view_))
    throw yielded(joint_, "did not " + purpose_, view_);
}

// The refusal may arrive before the state that explains it.
void GuardedJoint::wait_for_news() {
  const std::int64_t seen = view_.messages;
  client_.wait_until([&] { return view_.messages > seen + 1; }, Deadline(kOldStates_s));
  if (mode_of(view_) == Mode::kFaulted) throw faulted(client_, joint_);
  if (has_yielded(view_)) throw yielded(joint_, "did not " + purpose_, view_);
}

}  // namespace strainwave
