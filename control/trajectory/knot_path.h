// SPDX-License-Identifier: BSD-3-Clause
// The path of one joint: knots with time, position and velocity, and cubic Hermite segments between them. Reading it forwards takes constant
// time. The whole path is checked before anything moves. Joint side, SI. at() is real-time safe; a path is a plain struct that can be
// copied as bytes. Source: Hermite interpolation, and the extremes of polynomials.
//
// Between two knots, T apart, with the mean rate d = (p1 - p0) / T and u the time since the first:
//
//   a0 = (6 d - 4 v0 - 2 v1) / T
//   j  = 6 (v0 + v1 - 2 d) / T^2
//   p  = p0 + u v0 + u^2 a0 / 2 + u^3 j / 6
//   v  = v0 + u a0 + u^2 j / 2
//   a  = a0 + u j
//
// Position and velocity are continuous. The acceleration may step at knots. Positions are extreme at knots and where v = 0, velocities at
// knots and where a = 0, accelerations at knots.
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

/// The cubic Hermite segment between two knots, at an instant between theirs. Real-time safe.
Reference on_cubic(const PathKnot& from, const PathKnot& to, double time_s) noexcept;

struct KnotPath {
  static constexpr std::size_t kMostKnots = 320;
  std::array<PathKnot, kMostKnots> knots{};
  std::size_t count = 0;  ///< 2..kMostKnots

  const PathKnot& last() const noexcept { return knots[count - 1]; }
  double duration_s() const noexcept { return last().time_s; }
};

/// Reads a path forwards. The path must have passed find_defect().
class PathReader {
 public:
  /// The path at `time_s`, which must not be before that of the last call (a new reader begins at 0). After its end the path rests there. The
  /// reader remembers its segment, so that a period costs the same for any number of knots.
  Reference at(const KnotPath& path, double time_s) noexcept;

 private:
  std::size_t segment_ = 0;  ///< from this knot to the next
};

/// Limits of a joint on a path. All finite, speeds and accelerations > 0.
struct PathLimits {
  PositionRange range;
  MotionLimits motion;
  double torque_Nm = 0.0;     ///< > 0, compared with the torque of the inertia, without friction and load
  double inertia_kgm2 = 0.0;  ///< > 0
  double period_s = 0.0;      ///< > 0, the least time between two knots
};

inline constexpr double kLongestPath_s = 3600.0;

/// The first defect of `path` for a joint with these limits, or nothing. It checks all numbers first, then positions, then speeds, then the
/// segments. The text names the knot ("knot 3 (at 1.2 s): ", also for the segment that begins there), the wrong number, the allowed value
/// and its limit. Not real-time.
std::optional<std::string> find_defect(const KnotPath& path, const PathLimits& limits);

}  // namespace strainwave
