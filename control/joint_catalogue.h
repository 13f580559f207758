// The joints whose friction the catalogue knows, by the name of their model, and whether a table declares more than they have. The
// catalogue's file is compiled in, so that the daemon needs none. Not real-time. Source: data/friction_parameters.csv, Zhao (2006), Table 2.
//
// Friction is compensated towards the target, from either side: more of it than the joint has drives the joint instead of freeing it.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "control/friction.h"
#include "control/fuzzy_friction.h"

namespace strainwave {

struct CatalogueJoint {
  /// Friction at one temperature, motor side.
  struct Point {
    double temperature_C = 0.0;
    FrictionParameters motor_friction;
  };
  std::string model;          ///< "rhs17-6006"
  std::vector<Point> points;  ///< temperatures ascending

  /// Joint side of a gear of `gear_ratio`, straight between the catalogue's temperatures, and the nearest of them beyond the last.
  FrictionParameters friction_at(double temperature_C, double gear_ratio) const noexcept;
};

/// The joint of this model; null when the catalogue has none.
const CatalogueJoint* find_catalogue_joint(std::string_view model);

/// Where between rest and 10 rad/s, at a temperature of its range, `friction` (which must have passed find_defect()) is more than twice
/// `joint`'s: the worst such place by temperature, velocity, torque and what is allowed, in words; or nothing.
std::optional<std::string> find_excess_friction(const FuzzyFriction& friction, const CatalogueJoint& joint,
                                                double gear_ratio);

}  // namespace strainwave
