// SPDX-License-Identifier: BSD-3-Clause
// The settings of one joint in the loop (daemon/realtime/joint/joint_loop.h). Plain data.
#pragma once

#include <algorithm>

#include "control/joint_controller_config.h"
#include "daemon/realtime/joint/homing.h"
#include "daemon/realtime/joint/load_limits.h"
#include "daemon/realtime/joint/temperature_check.h"

namespace strainwave {

/// Limits of one joint, joint side. Exceeding one marked "fault" latches it; the reference stays within the position limits.
struct JointLimits {
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double position_margin_rad = 0.0;  ///< fault beyond position_min - margin and position_max + margin
  double overspeed_rad_s = 0.0;      ///< fault above
  double following_error_rad = 0.0;  ///< fault: |ordered reference - position|
  double derating_C = 0.0;           ///< above it, motions accelerate with less torque
  double temperature_limit_C = 0.0;  ///< fault above; > derating_C
  LoadLimitConfig load;              ///< the joint yields to a larger load

  /// Share of the torque limit for acceleration: 1 up to derating_C, then falling linearly, 0 from temperature_limit_C on.
  double driving_share(double temperature_C) const noexcept {
    return std::clamp((temperature_limit_C - temperature_C) / (temperature_limit_C - derating_C), 0.0, 1.0);
  }
};

/// The reaction of a joint to an overload.
enum class OverloadStop {
  kTorqueOff,  ///< fault: torque 0, drive off
  kHoldLoad,   ///< keeps the torque of the usual load until the push ends, then holds where the joint stops
};

struct JointLoopConfig {
  JointControllerConfig controller;
  JointLimits limits;
  TemperatureCheckConfig temperature;
  HomingConfig homing;
  int group = -1;                ///< joints with the same number >= 0 all stop when one of them faults
  double start_timeout_s = 2.0;  ///< from enable until the drive is ready
  double stop_timeout_s = 3.0;   ///< from disable to standstill
  double standstill_rad_s = 0.01;
  double blocked_s = 0.5;    ///< time at the torque limit without progress until the fault
  double overload_s = 0.02;  ///< time with too large a load until the joint yields
  OverloadStop overload_stop = OverloadStop::kTorqueOff;
  double rest_tolerance_rad = 1e-3;  ///< notice: the joint holds farther off its place; at least two counts
  double initial_load_Nm = 0.0;      ///< load in addition to gravity when first enabled; later the estimate
  double move_speed_share = 1.0;     ///< share of the speed limit, in (0, 1], for a move that gives no speed
  int missed_readings_limit = 5;     ///< periods without a fresh position until the fault
};

}  // namespace strainwave
