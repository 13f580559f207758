// SPDX-License-Identifier: BSD-3-Clause
// The joint's inertia and friction at the present temperature. Real-time safe. Source: Zhao (2006), (2-1)..(2-4).
//
//   F(w) = Fc + Fv w + (Fs - Fc) exp(-(w/ws)^2)
#pragma once

#include <cmath>

#include "base/units.h"
#include "control/friction/friction.h"

namespace strainwave {

struct JointModel {
  double inertia_kgm2 = 1.0;  ///< > 0
  FrictionParameters friction;
  StribeckShape stribeck;

  /// F(|w|) > 0; Fs at w = 0.
  double friction_Nm(double velocity_rad_s) const noexcept {
    return velocity_rad_s == 0.0 ? friction.static_Nm
                                 : std::abs(stribeck_friction_Nm(friction, stribeck, velocity_rad_s));
  }
  /// Mean friction torque while the velocity changes evenly from `begin_rad_s` to `end_rad_s`. If the joint reverses, each direction counts for
  /// its share of the time. 0 at rest.
  double friction_along_Nm(double begin_rad_s, double end_rad_s) const noexcept {
    if (begin_rad_s * end_rad_s >= 0.0) {
      const double mean_rad_s = 0.5 * (begin_rad_s + end_rad_s);
      return sign(mean_rad_s) * friction_Nm(mean_rad_s);
    }
    const double change_rad_s = std::abs(begin_rad_s) + std::abs(end_rad_s);
    return (begin_rad_s * friction_Nm(0.5 * begin_rad_s) + end_rad_s * friction_Nm(0.5 * end_rad_s)) /
           change_rad_s;
  }
};

}  // namespace strainwave
