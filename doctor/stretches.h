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
  std::vector<double>
      lost_Nm;  ///< by which less acts than any command lately, all of which pushed one way; 0: none
  std::vector<double> link_rad;  ///< NaN: none
  std::vector<bool> at_rest;     ///< the setpoint stands

  /// Whether a drive gives noticeably less than it should at sample `i`.
  bool torque_lost(std::size_t i) const { return lost_Nm[i] > 0.0; }
};

/// Up to three missing samples are bridged; a longer gap begins a new stretch. Those shorter than 40 samples are left out.
std::vector<Stretch> controlled_stretches(const Evidence& evidence);

/// Acceleration of a link that hangs on `told`'s spring times `scale`, where the motor's side of the spring is at `drive_rad` and
/// `load_Nm` holds the link back. Within the lost motion h a sliding element stiffens the spring (commission/motion_model.h):
///   torque = scale (spring(x) + K1 z),   z' = x' - |x'| z / (h / 2)
std::vector<double> link_acceleration(const std::vector<double>& drive_rad,
                                      const std::vector<double>& load_Nm, double step_s,
                                      const ConfiguredLink& told, double scale);

}  // namespace strainwave
