// SPDX-License-Identifier: BSD-3-Clause
// The path of one joint: knots with time, position and velocity, and the cubics of Hermite between them. Evaluated in constant time while
// time goes on, and checked as a whole before anything moves. Joint side, SI. at() is real-time safe; a path is a plain struct that can be
// copied as bytes. Source: the cubic that has two positions and two velocities, and the extremes of polynomials.
//
// Between two knots, T apart, with the mean rate d = (p1 - p0) / T and u the time since the first:
//
//   a0 = (6 d - 4 v0 - 2 v1) / T
//   j  = 6 (v0 + v1 - 2 d) / T^2
//   p  = p0 + u v0 + u^2 a0 / 2 + u^3 j / 6
//   v  = v0 + u a0 + u^2 j / 2
//   a  = a0 + u j
//
// Position and velocity have no step; the acceleration has one at knots, unless they were chosen so that it has none. Positions are
// extreme at knots and where v = 0, velocities where a = 0, accelerations at knots.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "control/trajectory/reference_shaper.h"

namespace strainwave {

struct PathKnot {
  double time_s = 0.0;
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
};

/// The cubic (Hermite) between two knots, at an instant between theirs. Real-time safe.
Reference on_cubic(const PathKnot& from, const PathKnot& to, double time_s) noexcept;

struct KnotPath {
  static constexpr std::size_t kMostKnots = 320;
  std::array<PathKnot, kMostKnots> knots{};
  std::size_t count = 0;  ///< 2..kMostKnots

  const PathKnot& last() const noexcept { return knots[count - 1]; }
  double duration_s() const noexcept { return last().time_s; }
};

/// Reads a path forwards. A path that is read has no defect (below).
class PathReader {
 public:
  /// The path at `time_s`, not before that of the last call (a new reader begins at 0); at its end from there on, at rest. The knot that
  /// it is at moves on with the time, so that a period costs the same whatever the number of knots.
  Reference at(const KnotPath& path, double time_s) noexcept;

 private:
  std::size_t segment_ = 0;  ///< from this knot to the next
};

/// What a joint can do on a path. All finite, speeds and accelerations > 0.
struct PathLimits {
  PositionRange range;
  MotionLimits motion;
  double torque_Nm = 0.0;     ///< > 0, for the inertia alone: friction and load take theirs besides
  double inertia_kgm2 = 0.0;  ///< > 0
  double period_s = 0.0;      ///< > 0: knots are not closer
};

inline constexpr double kLongestPath_s = 3600.0;

/// The first defect of `path` for a joint with these limits, knot by knot: of its numbers, then of its places, of its speeds, then of the
/// ways between them; nothing: it can be followed. "knot 3 (at 1.2 s): " at it, or between it and the next; the number that is wrong; what
/// is allowed, and by which limit. Not real-time.
std::optional<std::string> find_defect(const KnotPath& path, const PathLimits& limits);

}  // namespace strainwave
