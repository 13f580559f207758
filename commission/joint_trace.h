// SPDX-License-Identifier: BSD-3-Clause
// Trace of a joint's motion, period by period: the input of an identification. Joint side, SI. Plain data; it grows, so not real-time safe.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

namespace strainwave {

/// One period: the reading at its start, and the torque ordered then, which acts after the drive's delay.
struct JointSample {
  double motor_position_rad = 0.0;  ///< over all turns, referred to the joint
  double link_position_rad = std::numeric_limits<double>::quiet_NaN();  ///< NaN: no encoder on the link
  double torque_ordered_Nm = 0.0;
  /// Torque in the period before, as the drive measures it; NaN: it does not.
  double torque_applied_Nm = std::numeric_limits<double>::quiet_NaN();
  double temperature_C = std::numeric_limits<double>::quiet_NaN();  ///< NaN: not known
};

/// Samples without a gap.
struct JointTrace {
  double period_s = 0.001;              ///< > 0
  double encoder_resolution_rad = 0.0;  ///< of the motor's encoder, at the joint, >= 0
  std::vector<JointSample> samples;

  double time_s(std::size_t index) const noexcept { return period_s * static_cast<double>(index); }
};

}  // namespace strainwave
