// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/joint_model.h"

#include <cmath>

#include "control/units.h"

namespace strainwave {

double JointModel::friction_Nm(double velocity_rad_s) const noexcept {
  return velocity_rad_s == 0.0 ? friction.static_Nm
                               : std::abs(stribeck_friction_Nm(friction, stribeck, velocity_rad_s));
}

double JointModel::friction_along_Nm(double begin_rad_s, double end_rad_s) const noexcept {
  if (begin_rad_s * end_rad_s >= 0.0) {
    const double mean_rad_s = 0.5 * (begin_rad_s + end_rad_s);
    return sign(mean_rad_s) * friction_Nm(mean_rad_s);
  }
  const double change_rad_s = std::abs(begin_rad_s) + std::abs(end_rad_s);
  return (begin_rad_s * friction_Nm(0.5 * begin_rad_s) + end_rad_s * friction_Nm(0.5 * end_rad_s)) /
         change_rad_s;
}

}  // namespace strainwave
