// enable, clear-fault, take-over, release, revert-table: one message each, its answer, and where asked the mode that follows.
#include <fmt/format.h>

#include "client/commands/commands.h"
#include "client/commands/order_steps.h"

namespace strainwave {

namespace {

bool is_enabled(Mode mode) {
  return mode == Mode::kHolding || mode == Mode::kTracking || mode == Mode::kHoming;
}

}  // namespace

Mode mode_of(const JointView& view) {
  return static_cast<Mode>(view.state.mode);
}

command_v1 command_message(Action action) {
  command_v1 message{};
  message.action = static_cast<std::int32_t>(action);
  return message;
}

void order_accepted(Client& client, const std::string& joint, Action action) {
  const Answer answer = client.request(joint, channel_kind::kCommand, command_message(action));
  require_accepted(answer, joint, std::string(to_text(action)));
}

ClientError faulted(const std::string& joint, const JointView& view) {
  const auto fault = static_cast<Fault>(view.state.fault);
  return {ExitStatus::kRefused,
          fmt::format("{}: faulted ({}: {}); once the cause is gone: strainwavectl clear-fault {}", joint,
                      view.state.fault, to_text(fault), joint)};
}

void require_accepted(const Answer& answer, const std::string& joint, const std::string& what,
                      const std::string& hint) {
  if (answer.accepted) return;
  std::string message = fmt::format("{}: {} refused ({}, {})", joint, what, static_cast<int>(answer.reason),
                                    to_text(answer.reason));
  if (!answer.text.empty()) message += ": " + answer.text;
  if (!hint.empty()) message += "; " + hint;
  throw ClientError(ExitStatus::kRefused, message);
}

void enable(Client& client, const Output& output, const std::string& joint) {
  const bool already = is_enabled(mode_of(client.wait_for_joint(joint)));
  if (!already) order_accepted(client, joint, Action::kEnable);
  const JointView& view = *client.find(joint);
  const Deadline old_states(kOldStates_s);
  const auto decided = [&] {
    if (mode_of(view) == Mode::kFaulted) throw faulted(joint, view);
    if (mode_of(view) == Mode::kOff && old_states.passed()) {
      throw ClientError(ExitStatus::kRefused,
                        joint + ": went back to off while it was starting; see the daemon's log");
    }
    return is_enabled(mode_of(view));
  };
  if (!client.wait_until(decided, Deadline(client.options().timeout_s))) {
    throw ClientError(ExitStatus::kNoAnswer, fmt::format("{}: accepted, but still {} after {} s", joint,
                                                         to_text(mode_of(view)), client.options().timeout_s));
  }
  const std::string mode(to_text(mode_of(view)));
  say(output,
      fmt::format("{}: {}, {} at {:.6f} rad", joint, already ? "enabled already" : "enabled", mode,
                  view.state.joint_position_rad),
      {{"joint", joint},
       {"mode", mode},
       {"position_rad", view.state.joint_position_rad},
       {"already", already}});
}

void clear_fault(Client& client, const Output& output, const std::string& joint) {
  if (mode_of(client.wait_for_joint(joint)) != Mode::kFaulted)
    return say(output, joint + ": has no fault", {{"joint", joint}, {"already", true}});
  order_accepted(client, joint, Action::kClearFault);
  say(output, joint + ": fault cleared; enable it to go on", {{"joint", joint}, {"already", false}});
}

void revert_table(Client& client, const Output& output, const std::string& joint) {
  order_accepted(client, joint, Action::kRevertTable);
  say(output, joint + ": the previous table is in use again", {{"joint", joint}, {"accepted", true}});
}

void take_over(Client& client, const Output& output, const std::string& joint) {
  order_accepted(client, joint, Action::kTakeOver);
  say(output, joint + ": taken over; who had it is refused from now on",
      {{"joint", joint}, {"accepted", true}});
}

void release(Client& client, const Output& output, const std::string& joint) {
  order_accepted(client, joint, Action::kRelease);
  say(output, joint + ": released; the next who orders has it", {{"joint", joint}, {"accepted", true}});
}

}  // namespace strainwave
