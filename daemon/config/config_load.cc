// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_load.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

UsualLoad usual_load(const JointConfig& joint) {
  const JointControllerConfig& controller = joint.loop.controller;
  const double acceleration_rad_s2 =
      std::max(controller.motion.acceleration_rad_s2, controller.motion.deceleration_rad_s2);
  return {std::abs(controller.gravity.torque_Nm), joint.plant.inertia_kgm2 * acceleration_rad_s2,
          std::max(std::abs(joint.loop.initial_load_Nm), joint.loop.homing.stop_torque_Nm)};
}

void read_load_limits(TomlSection& limits, JointConfig& joint) {
  LoadLimitConfig& read = joint.loop.limits.load;
  read.usual = usual_load(joint);
  if (limits.has("load_Nm")) read.load_Nm = limits.number("load_Nm", kPositive);
  const double most_Nm = read.under(joint.loop.controller.torque_limit_Nm).load_Nm;
  if (limits.has("load_notice_Nm")) read.notice_Nm = limits.number("load_notice_Nm", {1e-6, most_Nm});
}

}  // namespace strainwave
