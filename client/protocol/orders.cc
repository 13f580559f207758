// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/orders.h"

#include <fmt/format.h>

#include <cmath>

#include "client/protocol/plain_zero.h"
#include "lcmtypes/reading_doubt.h"

namespace strainwave {

namespace {

bool is_enabled(Mode mode) {
  return mode == Mode::kHolding || mode == Mode::kTracking || mode == Mode::kHoming;
}

/// Waits for the mode that an accepted order leads to.
template <typename Decided>
void wait_for_mode(Client& client, const std::string& joint, const Decided& decided) {
  if (client.wait_until(decided, Deadline(client.options().timeout_s))) return;
  const JointView& view = *client.find(joint);
  const double timeout_s = client.options().timeout_s;
  const std::string silence = silence_of(view, timeout_s);
  const std::string mode(to_text(mode_of(view)));
  throw NoAnswer(
      silence.empty()
          ? fmt::format("{}: the order was accepted, but the joint is still {} after {} s", joint, mode,
                        timeout_s)
          : fmt::format("{}: the order was accepted, then {}; the last mode was {}", joint, silence, mode),
      joint);
}

}  // namespace

command_v1 command_message(Action action) {
  command_v1 message{};
  message.action = static_cast<std::int32_t>(action);
  return message;
}

Mode mode_of(const JointView& view) {
  return static_cast<Mode>(view.state.mode);
}

Faulted faulted(const Client& client, const std::string& joint) {
  const state_v1& state = client.find(joint)->state;
  const auto fault = static_cast<Fault>(state.fault);
  return {fmt::format("{}: faulted ({}: {}); once the cause is gone: {}", joint, state.fault,
                      fault_words(fault, state.drive_error),
                      client.advice("Joint::clear_fault()", "clear-fault", joint)),
          joint, fault};
}

bool has_yielded(const JointView& view) {
  return (view.state.notices & static_cast<std::int32_t>(Notice::kYielded)) != 0;
}

Yielded yielded(const std::string& joint, const std::string& undone, const JointView& view) {
  const state_v1& state = view.state;
  const std::string now = mode_of(view) == Mode::kHolding
                              ? fmt::format("it holds at {:.4g} rad", plain_zero(state.joint_position_rad))
                              : fmt::format("it is {}", to_text(mode_of(view)));
  return {fmt::format("{}: {}: it yielded to a load of {:.4g} N.m (load_Nm allows {:g}) at {:.4g} rad; {}",
                      joint, undone, std::abs(state.yield_load_Nm), state.yield_limit_Nm,
                      plain_zero(state.yield_position_rad), now),
          joint,
          {state.yield_load_Nm, state.yield_limit_Nm, state.yield_position_rad}};
}

std::string lines_of(const std::vector<ClientError>& errors) {
  std::string text;
  for (const ClientError& error : errors) text += (text.empty() ? "" : "\n") + std::string(error.what());
  return text;
}

void require_accepted(const Answer& answer, const std::string& joint, const std::string& what,
                      const std::string& hint) {
  if (answer.accepted) return;
  std::string message = fmt::format("{}: {} refused ({}, {})", joint, what, static_cast<int>(answer.reason),
                                    to_text(answer.reason));
  if (!answer.text.empty()) message += ": " + answer.text;
  if (!hint.empty()) message += "; " + hint;
  throw Refused(message, joint, answer.reason);
}

void order_accepted(Client& client, const std::string& joint, Action action) {
  const Answer answer = client.request(joint, channel_kind::kCommand, command_message(action));
  require_accepted(answer, joint, std::string(to_text(action)));
}

bool enable_joint(Client& client, const std::string& joint) {
  const bool already = is_enabled(mode_of(client.wait_for_joint(joint)));
  if (!already) order_accepted(client, joint, Action::kEnable);
  const JointView& view = *client.find(joint);
  const Deadline old_states(kOldStates_s);
  wait_for_mode(client, joint, [&] {
    if (mode_of(view) == Mode::kFaulted) throw faulted(client, joint);
    if (mode_of(view) == Mode::kOff && old_states.passed())
      throw NotDone(joint + ": went back to off while it was starting; see the daemon's log", joint);
    return is_enabled(mode_of(view));
  });
  return !already;
}

bool clear_joint_fault(Client& client, const std::string& joint) {
  if (mode_of(client.wait_for_joint(joint)) != Mode::kFaulted) return false;
  order_accepted(client, joint, Action::kClearFault);
  return true;
}

void wait_until_cleared(Client& client, const std::string& joint) {
  const JointView& view = client.wait_for_joint(joint);
  wait_for_mode(client, joint, [&] { return mode_of(view) != Mode::kFaulted; });
}

void send_stop(Client& client, const std::string& joint, Action stop) {
  try {
    const Answer answer = client.request_unseen(joint, channel_kind::kCommand, command_message(stop));
    require_accepted(answer, joint, std::string(to_text(stop)));
  } catch (const NoAnswer& error) {
    throw NoAnswer(
        fmt::format("{}: the stop was sent {} times, and no answer came: {}", joint,
                    PendingOrder::stop_patience(client.options().timeout_s).transmissions, error.what()),
        joint);
  }
}

void wait_until_off(Client& client, const std::string& joint) {
  const JointView& view = client.wait_for_joint(joint);
  wait_for_mode(client, joint, [&] {
    if (mode_of(view) == Mode::kFaulted) throw faulted(client, joint);
    return mode_of(view) == Mode::kOff;
  });
}

}  // namespace strainwave
