// SPDX-License-Identifier: BSD-3-Clause
// The settings of one joint in the loop (daemon/realtime/joint/joint_loop.h). Plain data.
#pragma once

#include <algorithm>

#include "control/joint_controller_config.h"
#include "daemon/realtime/joint/homing.h"
#include "daemon/realtime/joint/load_limits.h"
#include "daemon/realtime/joint/temperature_check.h"

namespace strainwave {

/// Limits of one joint, joint side. Exceeding one latches a fault; the reference never leaves the softer ones.
struct JointLimits {
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double position_margin_rad = 0.0;  ///< fault beyond position_min - margin and position_max + margin
  double overspeed_rad_s = 0.0;      ///< fault
  double following_error_rad = 0.0;  ///< fault: |what the orders make of the reference - position|
  double derating_C = 0.0;           ///< motions speed up with less torque above
  double temperature_limit_C = 0.0;  ///< fault above; > derating_C
  LoadLimitConfig load;              ///< the joint yields to a larger load

  /// Of the torque limit, with which motions speed up: 1 up to derating_C, then falling linearly, 0 from temperature_limit_C on.
  double driving_share(double temperature_C) const noexcept {
    return std::clamp((temperature_limit_C - temperature_C) / (temperature_limit_C - derating_C), 0.0, 1.0);
  }
};

/// What becomes of a joint that yields to a load.
enum class OverloadStop {
  kTorqueOff,  ///< fault: torque 0, drive off
  kHoldLoad,  ///< the torque is what held the load before, until the joint has been let go; then it holds where it comes to rest
};

struct JointLoopConfig {
  JointControllerConfig controller;
  JointLimits limits;
  TemperatureCheckConfig temperature;
  HomingConfig homing;
  int group = -1;                ///< joints with the same number >= 0 stop when one of them faults
  double start_timeout_s = 2.0;  ///< from enable to the drive's readiness
  double stop_timeout_s = 3.0;   ///< from disable to standstill
  double standstill_rad_s = 0.01;
  double blocked_s = 0.5;    ///< at the torque limit without progress, before it is a fault
  double overload_s = 0.02;  ///< that a load is too large, before the joint yields
  OverloadStop overload_stop = OverloadStop::kTorqueOff;
  double rest_tolerance_rad = 1e-3;  ///< notice: the joint holds farther from its place; at least two counts
  double initial_load_Nm =
      0.0;  ///< what holds the joint until it is first enabled holds this; later the estimate
  double move_speed_share = 1.0;  ///< of the speed limit, in (0, 1]: how fast a move is that names no speed
  int missed_readings_limit = 5;  ///< periods without a fresh position before it is a fault
};

}  // namespace strainwave
