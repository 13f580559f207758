// SPDX-License-Identifier: BSD-3-Clause
// The samples of a recording as stretches without a gap, evenly spaced, in which the joint was under control. Not real-time.
#pragma once

#include <vector>

#include "doctor/evidence.h"

namespace strainwave {

struct Stretch {
  double step_s = 0.0;
  std::vector<double> position_rad;
  std::vector<double> velocity_rad_s;  ///< of positions 4 ms before and after
  std::vector<double> torque_Nm;       ///< commanded
  std::vector<double> applied_Nm;
  std::vector<double> link_rad;   ///< NaN: none
  std::vector<bool> at_rest;      ///< the setpoint stands
  std::vector<bool> torque_lost;  ///< less acts than was commanded lately
};

/// Up to three missing samples are bridged; a longer gap begins a new stretch. Those shorter than 40 samples are left out.
std::vector<Stretch> controlled_stretches(const Evidence& evidence);

/// Acceleration of a link that hangs on `told`'s spring times `scale`, where the motor's side of the spring is at `drive_rad`.
std::vector<double> link_acceleration(const std::vector<double>& drive_rad, double step_s,
                                      const ConfiguredLink& told, double scale);

}  // namespace strainwave
