// SPDX-License-Identifier: BSD-3-Clause
// Strokes of a joint under the supervision of a program. Each is a stream of setpoints, which ends by itself
// soon after the program does. Not real-time.
#pragma once

#include <optional>
#include <strainwave/setpoint_v1.hpp>
#include <string>

#include "client/commands/guarded_motion.h"

namespace strainwave {

/// Throws ClientError (refused) unless the joint holds.
void require_holding(const JointView& view, const std::string& joint);

class GuardedStrokes {
 public:
  GuardedStrokes(Client& client, const std::string& joint, double max_torque_Nm)
      : client_(client),
        joint_(joint),
        max_torque_Nm_(max_torque_Nm),
        guarded_(client, joint, "end its motion") {}

  /// Returns once the joint's setpoint rests at `target_rad`. Throws ClientError when it is late, disturbed, or needs more torque than allowed.
  void go(double target_rad, double speed_rad_s);
  /// Waits with the same supervision.
  void rest(double duration_s);

 private:
  const state_v1& state() const { return client_.find(joint_)->state; }
  void begin(setpoint_v1 setpoint);
  bool arrived(double target_rad) const;
  void check(std::optional<double> target_rad);

  Client& client_;
  std::string joint_;
  double max_torque_Nm_;
  GuardedJoint guarded_;
};

}  // namespace strainwave
