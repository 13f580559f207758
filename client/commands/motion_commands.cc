// SPDX-License-Identifier: BSD-3-Clause
// move, home: orders whose motion the client can wait for.
#include <fmt/format.h>

#include "client/commands/commands.h"
#include "client/protocol/motion.h"
#include "client/text/text.h"
#include "strainwave/client_error.h"

namespace strainwave {

namespace {

/// Runs `wait`. Ctrl-C ends the waiting, not the motion. `goes_on` says in words how the joint moves on.
template <typename Wait>
auto interruptible(const std::string& joint, const std::string& goes_on, const Wait& wait) {
  try {
    return wait();
  } catch (const ClientError& error) {
    if (error.status() != ExitStatus::kInterrupted) throw;
    throw ClientError(
        error.status(),
        fmt::format("stopped waiting; {0} goes on {1}. To stop it: strainwavectl hold {0}", joint, goes_on));
  }
}

}  // namespace

void home(Client& client, const Output& output, const std::string& joint) {
  interruptible(joint, "homing", [&] { home_joint(client, joint); });
  const double position_rad = client.find(joint)->state.joint_position_rad;
  say(output, fmt::format("{}: homed, holding at {:.6f} rad", joint, without_negative_zero(position_rad, 6)),
      {{"joint", joint}, {"homed", true}, {"position_rad", position_rad}});
}

void move(Client& client, const Output& output, const MoveArguments& arguments) {
  const std::string& joint = arguments.joint;
  const double position_rad = arguments.position_rad;
  const MoveOrder order{position_rad, arguments.speed_limit_rad_s, arguments.tolerance_rad};
  if (!arguments.wait) {
    start_move(client, joint, order);
    return say(output, fmt::format("{}: moving to {} rad", joint, position_rad),
               {{"joint", joint}, {"target_rad", position_rad}, {"arrived", false}});
  }
  const Arrival arrival = interruptible(joint, fmt::format("to {} rad", position_rad),
                                        [&] { return move_joint(client, joint, order); });
  say(output,
      fmt::format("{}: arrived at {} rad in {}, error {} rad", joint, position_rad,
                  duration_text(arrival.duration_s), error_text(arrival.error_rad, arguments.tolerance_rad)),
      {{"joint", joint},
       {"target_rad", position_rad},
       {"arrived", true},
       {"duration_s", arrival.duration_s},
       {"error_rad", arrival.error_rad}});
}

}  // namespace strainwave
