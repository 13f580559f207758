// SPDX-License-Identifier: BSD-3-Clause
// What JointController (control/joint_controller.h) knows of its joint. Plain data. Joint side, SI.
#pragma once

#include <algorithm>
#include <optional>

#include "control/joint/drive_mode.h"
#include "control/joint/encoder_side.h"
#include "control/joint/gravity_load.h"
#include "control/joint/link_model.h"
#include "control/joint/motor_limits.h"
#include "control/mechanism.h"
#include "control/table/gain_table.h"
#include "control/trajectory/reference_shaper.h"

namespace strainwave {

struct JointControllerConfig {
  double period_s = 0.001;              ///< > 0, the table's
  double encoder_resolution_rad = 0.0;  ///< position of one count at the joint; 0: exact
  int delay_periods = 0;         ///< between a torque's computation and its effect, 0..kMaxControlDelay
  double torque_limit_Nm = 0.0;  ///< > 0; the table's limit applies as well
  double torque_limit_with(const GainTable& table) const noexcept {
    return std::min(torque_limit_Nm, table.torque_limit_Nm);
  }
  MotorLimits motor;
  MotionLimits motion;  ///< of the reference; what the joint can do limits it further
  /// Of the reference, > 0. Where it is so low that kMaxMeanPeriods do not suffice, accelerations are lower, too.
  std::optional<double> jerk_limit_rad_s3;
  /// Bridging of missing samples: a stream continues for so long; at least two and a half of its intervals, at most 0.2 s.
  double stream_bridge_s = 0.05;
  /// Play-out delay of samples with `utime`: the largest jitter of the network that is covered.
  double stream_delay_s = 0.03;
  /// Share of the torque that the reference leaves to the feedback, in [0, 1).
  double torque_reserve = 0.02;
  /// Motor and link with the gear between them; the target is the link's. Without it the joint is rigid, with its table's inertia.
  std::optional<LinkModel> link;
  EncoderSide encoder_side = EncoderSide::kMotor;
  DriveMode drive_mode = DriveMode::kTorque;
  bool drive_closes_loop() const noexcept { return closes_loop(drive_mode); }
  /// Of a drive's own loop of position, 0..period_s: how old the velocity is that it compares with the one that it is ordered, and how
  /// much later the torque acts that it is fed. 0 where the loop is the daemon's.
  double drive_loop_period_s = 0.0;
  /// Of link and payload. Loads that are known otherwise come on top.
  GravityLoad gravity;
  /// Studies alone: runs without it.
  Mechanism without = Mechanism::kNone;
};

}  // namespace strainwave
