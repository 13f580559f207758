// SPDX-License-Identifier: BSD-3-Clause
// The encoder rounds the position to whole counts. Real-time safe. Source: data/rhs17_datasheet.csv (1600
// lines on the motor, four counts each, ratio 50: 320000 counts per joint revolution, 19.6 urad).
#pragma once

#include <cmath>
#include <numbers>

namespace strainwave {

struct Encoder {
  double counts_per_joint_revolution = 0.0;  ///< 0: ideal, reads the exact position

  /// Size of one count in rad; 0 when ideal.
  double resolution_rad() const noexcept {
    return counts_per_joint_revolution > 0.0 ? 2.0 * std::numbers::pi / counts_per_joint_revolution : 0.0;
  }
  /// The reading at `joint_position_rad`: the position of the nearest whole count.
  double measure_rad(double joint_position_rad) const noexcept {
    if (counts_per_joint_revolution <= 0.0) return joint_position_rad;
    const double resolution = resolution_rad();
    return std::nearbyint(joint_position_rad / resolution) * resolution;
  }
};

}  // namespace strainwave
