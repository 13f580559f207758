// SPDX-License-Identifier: BSD-3-Clause
// Gravity torque of a link: m g l sin(link position - zero), pulling back towards the zero. Joint side, SI. Real-time safe.
#pragma once

#include <cmath>

namespace strainwave {

struct GravityLoad {
  double torque_Nm = 0.0;  ///< m g l >= 0
  double zero_rad = 0.0;   ///< where the link hangs

  /// Torque in N.m; a positive one opposes positive motor torque.
  double at(double link_position_rad) const noexcept {
    return torque_Nm == 0.0 ? 0.0 : torque_Nm * std::sin(link_position_rad - zero_rad);
  }
  /// Derivative of at() by the position, N.m/rad.
  double slope_at(double link_position_rad) const noexcept {
    return torque_Nm == 0.0 ? 0.0 : torque_Nm * std::cos(link_position_rad - zero_rad);
  }
};

}  // namespace strainwave
