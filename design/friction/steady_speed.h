// SPDX-License-Identifier: BSD-3-Clause
// Friction from motion at steady speeds, at which neither inertia nor a transient takes part of the torque.
// Joint side, SI. Offline.
//
//   J dw/dt = T - load(theta) - F(w)      so at steady speed     T = F(w) + load(theta)
//   There and back over the same stretch of positions the mean loads are equal and F changes its sign:
//   F(|w|) = (mean T there - mean T back) / 2,   load = (mean T there + mean T back) / 2
#pragma once

#include <vector>

namespace strainwave {

/// One recorded state.
struct MotionSample {
  double time_s = 0.0;  ///< by the daemon's cycle
  bool tracking = false;
  double setpoint_velocity_rad_s = 0.0;
  double joint_position_rad = 0.0;
  double joint_velocity_rad_s = 0.0;  ///< as the controller estimates or the drive measures it
  double torque_applied_Nm = 0.0;
  double temperature_C = 0.0;  ///< NaN: not known
};

/// When a stretch of constant setpoint velocity counts as steady motion of the joint.
struct SteadyCriteria {
  double settle_share = 0.2;       ///< of each run, left out at its beginning
  double settle_s = 0.05;          ///< least time that is left out
  int least_samples = 20;          ///< that must remain
  double speed_tolerance = 0.02;   ///< joint's mean speed against the setpoint's
  double ripple_tolerance = 0.02;  ///< deviation from a straight line, in units of the distance travelled
  /// Standard deviation of the velocity, in units of the speed. Slow joints stick and slip where friction
  /// falls with speed; the mean torque then belongs to no speed.
  double velocity_tolerance = 0.25;
  double inertia_tolerance = 0.02;  ///< torque that a change of speed takes, in units of the torque
  double least_overlap = 0.5;  ///< common part of the stretches there and back, in units of the longer one
};

/// Friction at one speed and temperature.
struct SteadyPoint {
  double temperature_C = 0.0;
  double speed_rad_s = 0.0;  ///< > 0
  double friction_Nm = 0.0;
  double load_Nm = 0.0;
  double speed_deviation_rad_s = 0.0;  ///< standard deviation of the speed about its mean, of the worse run
};

struct SteadyPoints {
  std::vector<SteadyPoint> points;
  // Runs at constant setpoint velocity that gave no point, by cause.
  int too_short = 0;
  int not_steady = 0;
  int no_temperature = 0;
  int without_return = 0;  ///< no run back over the same stretch followed
};

/// `samples` in the order of time. `inertia_kgm2` > 0 judges changes of speed.
SteadyPoints find_steady_points(const std::vector<MotionSample>& samples, double inertia_kgm2,
                                const SteadyCriteria& criteria = {});

}  // namespace strainwave
