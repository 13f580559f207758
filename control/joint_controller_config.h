// SPDX-License-Identifier: BSD-3-Clause
// Configuration of a JointController (control/joint_controller.h). Plain data. Joint side, SI.
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
  double period_s = 0.001;              ///< > 0, equal to the table's
  double encoder_resolution_rad = 0.0;  ///< position of one count at the joint; 0: exact
  int delay_periods = 0;         ///< between a torque's computation and its effect, 0..kMaxControlDelay
  double torque_limit_Nm = 0.0;  ///< > 0; the table's limit applies as well
  double torque_limit_with(const GainTable& table) const noexcept {
    return std::min(torque_limit_Nm, table.torque_limit_Nm);
  }
  MotorLimits motor;
  MotionLimits motion;  ///< of the reference; the joint's torque limits it further
  /// Jerk limit of the reference, > 0. Since smoothing lasts at most 2 kMaxMeanPeriods, a very low limit also lowers the accelerations.
  std::optional<double> jerk_limit_rad_s3;
  /// How long a stream continues without samples. The stream buffer uses at least two and a half intervals, and at most 0.2 s.
  double stream_bridge_s = 0.05;
  /// Play-out delay of samples with `utime`: the largest network jitter that it covers.
  double stream_delay_s = 0.03;
  /// Share of the torque that the reference leaves to the feedback, in [0, 1).
  double torque_reserve = 0.02;
  /// Motor and link with the gear between them; targets are the link's. Empty: a rigid joint with its table's inertia.
  std::optional<LinkModel> link;
  EncoderSide encoder_side = EncoderSide::kMotor;
  DriveMode drive_mode = DriveMode::kTorque;
  bool drive_closes_loop() const noexcept { return closes_loop(drive_mode); }
  /// Period of the drive's own position loop, 0..period_s; 0 where the daemon closes the loop. The drive compares the ordered velocity with
  /// a velocity that is this old, and its torque feed-forward acts this much later.
  double drive_loop_period_s = 0.0;
  /// Gravity of link and payload. Other known loads are added.
  GravityLoad gravity;
  /// For studies only: the mechanism that is switched off.
  Mechanism without = Mechanism::kNone;
};

}  // namespace strainwave
