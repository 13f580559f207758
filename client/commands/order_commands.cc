// enable, disable, hold, clear-fault, home, revert-table, move: one message each, its answer, and where asked the mode that
// follows.
#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <strainwave/command_v1.hpp>
#include <strainwave/setpoint_v1.hpp>

#include "client/commands/commands.h"
#include "client/link/exit_status.h"

namespace strainwave {

namespace {

// A state that left the daemon before it took the order may still arrive after the acknowledgement.
constexpr double kOldStates_s = 0.1;

Mode mode_of(const JointView& view) {
  return static_cast<Mode>(view.state.mode);
}

command_v1 command(Action action) {
  command_v1 message{};
  message.action = static_cast<std::int32_t>(action);
  return message;
}

void order(Client& client, const std::string& joint, Action action) {
  const Answer answer = client.request(joint, channel_kind::kCommand, command(action));
  require_accepted(answer, joint, std::string(to_text(action)));
}

ClientError faulted(const std::string& joint, const JointView& view) {
  const auto fault = static_cast<Fault>(view.state.fault);
  return {ExitStatus::kRefused,
          fmt::format("{}: faulted ({}: {}); once the cause is gone: strainwavectl clear-fault {}", joint,
                      view.state.fault, to_text(fault), joint)};
}

/// A motion that is waited for.
struct Motion {
  Mode mode;            ///< while it lasts
  std::string purpose;  ///< in words, after "did not"
  std::function<bool(const JointView&)> replaced =
      nullptr;  ///< by another order of this kind; null: cannot be
};

/// What ends the wait before the joint is there, in words; empty while it is on its way.
std::string motion_ended(const JointView& view, const Motion& motion, std::int64_t session_id) {
  if (view.state.session_id != session_id) return "the daemon was restarted";
  const Mode mode = mode_of(view);
  if (mode == Mode::kOff || mode == Mode::kStopping) return "the joint was disabled";
  if (motion.replaced && motion.replaced(view)) return "another order replaced this one";
  return "";
}

void wait_until_holding(Client& client, const std::string& joint, const Motion& motion) {
  const JointView& view = *client.find(joint);
  const std::int64_t session_id = view.state.session_id;
  const Deadline old_states(kOldStates_s);
  bool motion_seen = false;
  while (true) {
    const std::int64_t seen = view.messages;
    if (!client.wait_until([&] { return view.messages != seen; }, Deadline(client.options().timeout_s))) {
      throw ClientError(
          ExitStatus::kNoAnswer,
          fmt::format("{}: the daemon fell silent during the motion; the joint's state is not known", joint));
    }
    const Mode mode = mode_of(view);
    if (mode == Mode::kFaulted) throw faulted(joint, view);
    motion_seen = motion_seen || mode == motion.mode;
    if (!motion_seen && !old_states.passed()) continue;
    if (const std::string end = motion_ended(view, motion, session_id); !end.empty()) {
      throw ClientError(ExitStatus::kRefused, fmt::format("{}: did not {}: {}", joint, motion.purpose, end));
    }
    if (mode == Mode::kHolding) return;
  }
}

}  // namespace

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
  order(client, joint, Action::kEnable);
  const JointView& view = *client.find(joint);
  const Deadline old_states(kOldStates_s);
  const auto decided = [&] {
    if (mode_of(view) == Mode::kFaulted) throw faulted(joint, view);
    if (mode_of(view) == Mode::kOff && old_states.passed()) {
      throw ClientError(ExitStatus::kRefused,
                        joint + ": went back to off while it was starting; see the daemon's log");
    }
    return mode_of(view) == Mode::kHolding || mode_of(view) == Mode::kTracking;
  };
  if (!client.wait_until(decided, Deadline(client.options().timeout_s))) {
    throw ClientError(ExitStatus::kNoAnswer, fmt::format("{}: accepted, but still {} after {} s", joint,
                                                         to_text(mode_of(view)), client.options().timeout_s));
  }
  output.stream << fmt::format("{}: enabled, holding at {:.6f} rad\n", joint, view.state.joint_position_rad);
}

void disable(Client& client, const Output& output, const std::string& joint) {
  const Answer answer = client.request_unseen(joint, channel_kind::kCommand, command(Action::kDisable));
  require_accepted(answer, joint, std::string(to_text(Action::kDisable)));
  const JointView& view = client.wait_for_joint(joint);
  const auto decided = [&] {
    if (mode_of(view) == Mode::kFaulted) throw faulted(joint, view);
    return mode_of(view) == Mode::kOff;
  };
  if (!client.wait_until(decided, Deadline(client.options().timeout_s))) {
    throw ClientError(ExitStatus::kNoAnswer, fmt::format("{}: accepted, but still {} after {} s", joint,
                                                         to_text(mode_of(view)), client.options().timeout_s));
  }
  output.stream << joint << ": disabled\n";
}

void hold(Client& client, const Output& output, const std::string& joint) {
  order(client, joint, Action::kHold);
  output.stream << joint << ": holding where it stops\n";
}

void clear_fault(Client& client, const Output& output, const std::string& joint) {
  order(client, joint, Action::kClearFault);
  output.stream << joint << ": fault cleared; enable it to go on\n";
}

void revert_table(Client& client, const Output& output, const std::string& joint) {
  order(client, joint, Action::kRevertTable);
  output.stream << joint << ": the previous table is in use again\n";
}

void home(Client& client, const Output& output, const std::string& joint) {
  order(client, joint, Action::kHome);
  try {
    wait_until_holding(client, joint, {Mode::kHoming, "find home"});
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
    throw ClientError(
        error.status(),
        fmt::format("stopped waiting; {0} goes on homing. To stop it: strainwavectl hold {0}", joint));
  }
  const state_v1& state = client.find(joint)->state;
  if ((state.notices & static_cast<std::int32_t>(Notice::kNotHomed)) != 0)
    throw ClientError(ExitStatus::kRefused, joint + ": homing was stopped before it found home");
  output.stream << fmt::format("{}: homed, holding at {:.6f} rad\n", joint, state.joint_position_rad);
}

void move(Client& client, const Output& output, const MoveArguments& arguments) {
  const auto& [joint, position_rad, wait, speed_limit_rad_s] = arguments;
  setpoint_v1 message{};
  message.position_rad = position_rad;
  message.speed_limit_rad_s = speed_limit_rad_s;
  message.acknowledge = 1;
  const Answer answer = client.request(joint, channel_kind::kSetpoint, message);
  std::string hint;
  if (answer.reason == Reason::kOutOfRange && std::abs(position_rad) > 2.0 * std::numbers::pi) {
    hint = fmt::format("positions are in rad: {} degrees would be {:.6g}", position_rad,
                       position_rad * std::numbers::pi / 180.0);
  }
  require_accepted(answer, joint, fmt::format("move to {} rad", position_rad), hint);
  if (!wait) {
    output.stream << fmt::format("{}: moving to {} rad\n", joint, position_rad);
    return;
  }
  try {
    wait_until_holding(
        client, joint,
        {Mode::kTracking, fmt::format("arrive at {} rad", position_rad),
         [&](const JointView& view) { return view.state.target_position_rad != position_rad; }});
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
    throw ClientError(error.status(),
                      fmt::format("stopped waiting; {} goes on to {} rad. To stop it: strainwavectl "
                                  "hold {}",
                                  joint, position_rad, joint));
  }
  output.stream << fmt::format("{}: arrived at {} rad, error {:.2e} rad\n", joint, position_rad,
                               tracking_error_rad(*client.find(joint)));
}

}  // namespace strainwave
