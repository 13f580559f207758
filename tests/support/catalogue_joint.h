// SPDX-License-Identifier: BSD-3-Clause
// The joint of tests/support/two_mass_joint.h with the numbers of the catalogue.
#pragma once

#include <cmath>
#include <numbers>

#include "tests/support/two_mass_joint.h"

namespace strainwave::testing {

// The catalogue's gear csf-17-50 and actuator RHS-17-6006, typed from their pages.
inline constexpr double kRatio = 50.0;
inline constexpr double kTorquePerNcm = 0.01 * kRatio;
inline constexpr double kMotor_kgm2 = 0.089;
inline constexpr double kPeak_Nm = 34.0;
inline constexpr double kStall_Nm = 150.0;
inline constexpr double kTorquePerSpeed_Nms_rad = 19.1;

inline double damping_Nms_rad(double link_kgm2, double ratio) {
  return 2.0 * ratio * 8100.0 / std::sqrt(8100.0 * (1.0 / kMotor_kgm2 + 1.0 / link_kgm2));
}

inline TwoMassData catalogue_joint(double temperature_C, double link_kgm2, double damping_ratio,
                                   int delay_periods) {
  TwoMassData data;
  data.link_kgm2 = link_kgm2;
  data.slopes_Nm_rad = {8100.0, 11000.0, 13000.0};
  data.corners_Nm = {3.9, 12.0};
  data.damping_Nms_rad = damping_Nms_rad(link_kgm2, damping_ratio);
  const double cold = std::exp(-(temperature_C + 12.803) / 11.28);
  data.static_Nm = kTorquePerNcm * (3.1204 + 6.6525 * cold);
  data.coulomb_Nm = kTorquePerNcm * (1.5204 + 6.6525 * cold);
  data.viscous_Nms_rad =
      kTorquePerNcm * kRatio * 60.0 / (2.0 * std::numbers::pi) * (0.0011702 + 0.01181 * cold);
  data.stribeck_rad_s = 20.0 * 2.0 * std::numbers::pi / 60.0 / kRatio;
  data.stall_Nm = kStall_Nm;
  data.torque_per_speed_Nms_rad = kTorquePerSpeed_Nms_rad;
  data.delay_periods = delay_periods;
  return data;
}

}  // namespace strainwave::testing
