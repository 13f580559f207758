// SPDX-License-Identifier: BSD-3-Clause
// Motions that are waited for: to a position, to the home position, to a stop. Throw ClientError: Refused, NoAnswer, Faulted,
// Yielded, NotDone.
// Not real-time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "strainwave/move_order.h"

namespace strainwave {

/// Where one of several joints goes, joint side.
struct JointTarget {
  std::string joint;
  double position_rad = 0.0;
};

/// What to say of a position that was refused and may be meant in degrees; empty when it cannot be.
std::string degrees_hint(double position_rad);

/// "-9.90e-04": an error, with as many more digits as tell on which side of `tolerance_rad` it is.
std::string error_text(double error_rad, double tolerance_rad);

/// "1.234 s", or "less than 0.01 s": two states of a joint are that far apart.
std::string duration_text(double duration_s);

/// Orders the move; the joint is on its way.
void start_move(Client& client, const std::string& joint, const MoveOrder& order);

/// Returns once the joint is inside the tolerance and has stayed there for a tenth of a second. An exception does
/// not end the motion.
Arrival move_joint(Client& client, const std::string& joint, const MoveOrder& order);

/// Of joints that are on their way: returns once each is inside the tolerance of its target and has stayed there. In the order of `targets`,
/// timed from the call.
/// `look` is called again and again meanwhile, and may throw.
std::vector<Arrival> wait_until_arrived(Client& client, const std::vector<JointTarget>& targets,
                                        double tolerance_rad, const std::function<void()>& look = nullptr);

/// Finds the home position; returns once the joint holds there.
void home_joint(Client& client, const std::string& joint);

/// After a hold was accepted: returns once the joint holds.
void wait_until_holding(Client& client, const std::string& joint);

}  // namespace strainwave
