// SPDX-License-Identifier: BSD-3-Clause
// The joints whose friction the catalogue knows, by the name of their model or their gear's. The catalogue's files are compiled in, so that
// the daemon needs none. Not real-time. Source: data/friction_parameters.csv, Zhao (2006), Table 2; data/rhs17_datasheet.csv, his
// Appendix A.
#pragma once

#include <string>
#include <string_view>
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

/// Every joint; the first is that of Zhao (2006), the reference of the design.
const std::vector<CatalogueJoint>& joint_catalogue();

/// The joint with this gear; null when the catalogue has none.
const CatalogueJoint* find_catalogue_joint_with_gear(std::string_view gear);

/// The Stribeck curve of the catalogue's friction, joint side: 20 RPM at the motor, exponent 2 (data/README.md).
StribeckShape source_stribeck_shape(double gear_ratio);

}  // namespace strainwave
