// SPDX-License-Identifier: BSD-3-Clause
// The joint whose friction the catalogue contains. The build compiles the catalogue's files in, so that the daemon needs no file. Not real-time.
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

  /// On the joint side of a gear of `gear_ratio`. Linear between the catalogue's temperatures, and constant beyond them.
  FrictionParameters friction_at(double temperature_C, double gear_ratio) const noexcept;
};

/// The joint of Zhao (2006), the reference of the design.
const CatalogueJoint& catalogue_joint();

}  // namespace strainwave
