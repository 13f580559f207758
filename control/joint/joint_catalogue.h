// SPDX-License-Identifier: BSD-3-Clause
// The joint whose friction the catalogue knows. The catalogue's files are compiled in, so that the daemon needs none. Not real-time.
// Source: data/friction_parameters.csv, Zhao (2006), Table 2; data/rhs17_datasheet.csv, his Appendix A.
#pragma once

#include <string>
#include <vector>

#include "control/friction/friction.h"

namespace strainwave {

struct CatalogueJoint {
  /// Friction at one temperature, motor side.
  struct Point {
    double temperature_C = 0.0;
    FrictionParameters motor_friction;
  };
  std::string model;                ///< "rhs17-6006"
  std::string gear;                 ///< "csf-17-50", of gear_catalogue.h
  double motor_inertia_kgm2 = 0.0;  ///< the actuator's own, at the joint
  std::vector<Point> points;        ///< temperatures ascending

  /// Joint side of a gear of `gear_ratio`, straight between the catalogue's temperatures, and the nearest of them beyond the last.
  FrictionParameters friction_at(double temperature_C, double gear_ratio) const noexcept;
};

/// That of Zhao (2006), the reference of the design.
const CatalogueJoint& catalogue_joint();

}  // namespace strainwave
