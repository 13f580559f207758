// SPDX-License-Identifier: BSD-3-Clause
// Divides the samples of a recording into evenly spaced stretches without gaps, in which the joint was under control. Not real-time.
#pragma once

#include <vector>

#include "doctor/evidence.h"

namespace strainwave {

struct Stretch {
  double step_s = 0.0;
  std::vector<double> position_rad;
  std::vector<double> velocity_rad_s;  ///< from positions 4 ms before and after
  std::vector<double> torque_Nm;       ///< commanded
  std::vector<double> applied_Nm;
  std::vector<double>
      lost_Nm;  ///< shortfall against the smallest recent command, if all have one sign; 0: none
  std::vector<double> link_rad;  ///< NaN: not measured
  std::vector<bool> at_rest;     ///< the setpoint is constant

  /// Whether a drive gives noticeably less than it should at sample `i`.
  bool torque_lost(std::size_t i) const { return lost_Nm[i] > 0.0; }
};

/// Up to three missing samples are bridged; a longer gap begins a new stretch. Stretches shorter than 40 samples are left out.
std::vector<Stretch> controlled_stretches(const Evidence& evidence);

/// Acceleration of a link on `told`'s spring with its stiffness times `scale`. The motor side of the spring is at `drive_rad`, and
/// `load_Nm` opposes positive torque. Within the lost motion h a sliding element stiffens the spring (commission/motion_model.h):
///   torque = scale (spring(x) + K1 z),   z' = x' - |x'| z / (h / 2)
std::vector<double> link_acceleration(const std::vector<double>& drive_rad,
                                      const std::vector<double>& load_Nm, double step_s,
                                      const ConfiguredLink& told, double scale);

}  // namespace strainwave
