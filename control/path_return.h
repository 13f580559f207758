// Where joints go on along a path that nobody led for a while: at the time at which the path is nearest to where they are by now, as fast
// as they go along it. What is left of a joint's place and speed beside the path goes away evenly meanwhile. Real-time safe; a search costs some
// hundred looks at each joint's path. Joint side, SI.
//
//   time   the s at which  sum_i (p_i(s - late_i r) - position_i)^2 + (w (s - usual))^2  is least; w so small that it decides between
//          places that are equally near, as where the path rests or comes twice
//   rate   the r at which  sum_i (v_i(s - late_i r) r - velocity_i)^2  is least, in [0, 1]; where the path itself rests, the one that it had
//   back   from (off, v, 0) to (0, 0, 0) in T by a quintic:  off (1 - 10 u^3 + 15 u^4 - 6 u^5) + v T (u - 6 u^3 + 8 u^4 - 3 u^5),  u = t / T
#pragma once

#include <span>

#include "control/knot_path.h"
#include "control/path_clock.h"

namespace strainwave {

/// One joint beside its path.
struct StrayJoint {
  const KnotPath* path = nullptr;
  double position_rad = 0.0;    ///< from which its setpoint goes on ...
  double velocity_rad_s = 0.0;  ///< ... and how fast
  double late_s = 0.0;          ///< >= 0: that its setpoint is behind the path's time, at the full rate
  PathReader reader{};          ///< scratch
};

/// Times of the path in which to look, and where it was last.
struct PathWindow {
  double begin_s = 0.0;  ///< >= 0
  double end_s = 0.0;    ///< >= begin_s
  PathTime last;         ///< inside
};

/// Without joints, where it was last.
PathTime nearest_time(std::span<StrayJoint> joints, const PathWindow& window) noexcept;

/// A joint's way back to its path; one that has not begun is over.
class WayBack {
 public:
  /// From so far off its path, and so much faster than that. `duration_s` > 0.
  void begin(double off_rad, double off_rad_s, double duration_s) noexcept;
  /// What comes on top of the path, so much later.
  PathPoint step(double elapsed_s) noexcept;

 private:
  double off_rad_ = 0.0;
  double off_rad_s_ = 0.0;
  double duration_s_ = 1.0;
  double since_s_ = 1.0;
};

}  // namespace strainwave
