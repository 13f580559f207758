// SPDX-License-Identifier: BSD-3-Clause
// Motions with a wait: to a position, to the home position, to a stop. They throw ClientError: Refused,
// NoAnswer, Faulted, Yielded, NotDone. Not real-time.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "strainwave/move_order.h"

namespace strainwave {

/// The target of one of several joints, joint side.
struct JointTarget {
  std::string joint;
  double position_rad = 0.0;
};

/// A hint for a refused position that may be meant in degrees. Empty if it cannot be.
std::string degrees_hint(double position_rad);

/// "-9.90e-04": an error, with enough digits to show on which side of `tolerance_rad` it lies.
std::string error_text(double error_rad, double tolerance_rad);

/// "1.234 s", or "less than 0.01 s", which is the time between two states of a joint.
std::string duration_text(double duration_s);

/// Orders the move and returns at once.
void start_move(Client& client, const std::string& joint, const MoveOrder& order);

/// Returns once the joint is inside the tolerance and has stayed there for a tenth of a second. An exception
/// does not end the motion.
Arrival move_joint(Client& client, const std::string& joint, const MoveOrder& order);

/// Waits for moving joints: returns once each is inside the tolerance of its target and has stayed there. The
/// arrivals have the order of `targets` and are timed from the call. `look` is called repeatedly during the
/// wait, and may throw.
std::vector<Arrival> wait_until_arrived(Client& client, const std::vector<JointTarget>& targets,
                                        double tolerance_rad, const std::function<void()>& look = nullptr);

/// Finds the home position. Returns once the joint holds there.
void home_joint(Client& client, const std::string& joint);

/// Call it after the daemon has accepted a hold. Returns once the joint holds.
void wait_until_holding(Client& client, const std::string& joint);

}  // namespace strainwave
