// move, home: an order whose motion is waited for.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <strainwave/setpoint_v2.hpp>

#include "client/commands/commands.h"
#include "client/commands/order_steps.h"

namespace strainwave {

namespace {

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

/// Waits for `done`, which is asked again and again once the order is in force.
void wait_for_motion(Client& client, const std::string& joint, const Motion& motion,
                     const std::function<bool(const JointView&)>& done) {
  constexpr double kLook_s = 0.01;
  const JointView& view = *client.find(joint);
  const std::int64_t session_id = view.state.session_id;
  const Deadline old_states(kOldStates_s);
  bool motion_seen = false;
  while (true) {
    const std::int64_t seen = view.messages;
    client.wait_until([&] { return view.messages != seen; }, Deadline(kLook_s));
    if (seconds_between(view.received, now()) > client.options().timeout_s)
      throw ClientError(
          ExitStatus::kNoAnswer,
          fmt::format("{}: the daemon fell silent during the motion; the joint's state is not known", joint));
    const Mode mode = mode_of(view);
    if (mode == Mode::kFaulted) throw faulted(joint, view);
    motion_seen = motion_seen || mode == motion.mode;
    if (!motion_seen && !old_states.passed()) continue;
    if (const std::string end = motion_ended(view, motion, session_id); !end.empty()) {
      throw ClientError(ExitStatus::kRefused, fmt::format("{}: did not {}: {}", joint, motion.purpose, end));
    }
    if (done(view)) return;
  }
}

/// Inside a tolerance of a target, and staying there.
class Arrival {
 public:
  Arrival(double target_rad, double tolerance_rad, double patience_s)
      : target_rad_(target_rad), tolerance_rad_(tolerance_rad), patience_s_(patience_s), start_(now()) {}

  /// True once the joint has been inside for long enough. Throws ClientError (refused) when it holds outside.
  bool reached(const std::string& joint, const JointView& view) {
    constexpr double kStay_s = 0.1;
    if (!(std::abs(error_rad(view)) <= tolerance_rad_))
      inside_.reset();
    else if (!inside_)
      inside_ = view.received;
    if (mode_of(view) != Mode::kHolding) {
      holding_.reset();
      return false;
    }
    if (!holding_) holding_ = now();
    if (inside_ && seconds_between(*inside_, now()) >= kStay_s) return true;
    if (seconds_between(*holding_, now()) > patience_s_)
      throw ClientError(ExitStatus::kRefused,
                        fmt::format("{}: holds {:.2e} rad away from {} rad, outside of --tolerance_rad {}",
                                    joint, error_rad(view), target_rad_, tolerance_rad_));
    return false;
  }
  /// From the order to when it was inside for good.
  double duration_s() const { return std::max(0.0, seconds_between(start_, *inside_)); }
  double error_rad(const JointView& view) const { return target_rad_ - view.state.joint_position_rad; }

 private:
  double target_rad_;
  double tolerance_rad_;
  double patience_s_;
  Instant start_;
  std::optional<Instant> inside_;
  std::optional<Instant> holding_;
};

}  // namespace

void home(Client& client, const Output& output, const std::string& joint) {
  order_accepted(client, joint, Action::kHome);
  try {
    wait_for_motion(client, joint, {Mode::kHoming, "find home"},
                    [](const JointView& view) { return mode_of(view) == Mode::kHolding; });
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
    throw ClientError(
        error.status(),
        fmt::format("stopped waiting; {0} goes on homing. To stop it: strainwavectl hold {0}", joint));
  }
  const state_v1& state = client.find(joint)->state;
  if ((state.notices & static_cast<std::int32_t>(Notice::kNotHomed)) != 0)
    throw ClientError(ExitStatus::kRefused, joint + ": homing was stopped before it found home");
  say(output, fmt::format("{}: homed, holding at {:.6f} rad", joint, state.joint_position_rad),
      {{"joint", joint}, {"homed", true}, {"position_rad", state.joint_position_rad}});
}

void move(Client& client, const Output& output, const MoveArguments& arguments) {
  const std::string& joint = arguments.joint;
  const double position_rad = arguments.position_rad;
  setpoint_v2 message{};
  message.position_rad = position_rad;
  message.speed_limit_rad_s = arguments.speed_limit_rad_s;
  message.acknowledge = 1;
  const Answer answer = client.request(joint, channel_kind::kSetpoint, message);
  Arrival arrival(position_rad, arguments.tolerance_rad, client.options().timeout_s);
  std::string hint;
  if (answer.reason == Reason::kOutOfRange && std::abs(position_rad) > 2.0 * std::numbers::pi) {
    hint = fmt::format("positions are in rad: {} degrees would be {:.6g}", position_rad,
                       position_rad * std::numbers::pi / 180.0);
  }
  require_accepted(answer, joint, fmt::format("move to {} rad", position_rad), hint);
  if (!arguments.wait) {
    say(output, fmt::format("{}: moving to {} rad", joint, position_rad),
        {{"joint", joint}, {"target_rad", position_rad}, {"arrived", false}});
    return;
  }
  try {
    wait_for_motion(client, joint,
                    {Mode::kTracking, fmt::format("arrive at {} rad", position_rad),
                     [&](const JointView& view) { return view.state.target_position_rad != position_rad; }},
                    [&](const JointView& view) { return arrival.reached(joint, view); });
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
    throw ClientError(error.status(),
                      fmt::format("stopped waiting; {} goes on to {} rad. To stop it: strainwavectl "
                                  "hold {}",
                                  joint, position_rad, joint));
  }
  const double error_rad = arrival.error_rad(*client.find(joint));
  say(output,
      fmt::format("{}: arrived at {} rad in {:.3f} s, error {:.2e} rad", joint, position_rad,
                  arrival.duration_s(), error_rad),
      {{"joint", joint},
       {"target_rad", position_rad},
       {"arrived", true},
       {"duration_s", arrival.duration_s()},
       {"error_rad", error_rad}});
}

}  // namespace strainwave
