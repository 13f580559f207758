// SPDX-License-Identifier: BSD-3-Clause
// Paths as one chooses them on a robot, drawn at random, and where they are by the basis of Hermite: nothing of this is the daemon's own.
// Joint side, SI.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace strainwave::testing {

struct DrawnKnot {
  double time_s = 0.0;
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
};
/// What one joint does: 2 to 300 knots from 0, at rest at both ends.
using DrawnPart = std::vector<DrawnKnot>;

struct DrawnPath {
  std::string kind;
  std::vector<DrawnPart> parts;  ///< one for each joint, at the same times
  double duration_s() const { return parts.front().back().time_s; }
};

/// What no drawn path exceeds.
struct DrawnWithin {
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
  double duration_s = 0.0;
};

/// One of: splines through a few points, and the same taught in many; hand-taught points, rounded to 0.1 mrad; quintics from rest to rest.
DrawnPath draw_path(std::mt19937_64& random, std::size_t joints, const DrawnWithin& within);

struct DrawnPoint {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
};
/// At rest before and after it. At a knot with the acceleration after it.
DrawnPoint evaluate(const DrawnPart& part, double time_s);

/// Accelerations at the ends of the way from `knot` to the next, where they are largest.
struct EndAccelerations {
  double begin_rad_s2 = 0.0;
  double end_rad_s2 = 0.0;
};
EndAccelerations end_accelerations(const DrawnPart& part, std::size_t knot);

/// A part that no joint with these limits can follow, and how its refusal names that.
struct Infeasible {
  DrawnPart part;
  std::string place;  ///< "knot 3 ("
  std::string limit;
};
/// One inner knot's velocity is too large.
Infeasible too_fast(std::mt19937_64& random, DrawnPart part, double speed_rad_s);
/// The way to the farthest next knot is left too little time; what comes after it comes earlier by that. `period_s`: no knots are closer.
Infeasible too_short(DrawnPart part, double acceleration_rad_s2, double period_s);

}  // namespace strainwave::testing
