// SPDX-License-Identifier: BSD-3-Clause
// Whether a position reading can be true: two tests that need no more than mechanics. Real-time safe.
//
// Jump: between two readings the joint cannot have moved faster than twice its overspeed limit.
//
// Stuck: a joint at rest under a constant load L and torque T0 has |T0 - L| <= Fs. When the torque
// then becomes T, at least |T - T0| - 2 Fs of it accelerates the joint, whatever L is:
//     displacement >= integral integral max(0, |T - T0| - 2 Fs) / J  dt dt
// A sensor that shows no change although that displacement, those to either side against each other, is many counts is stuck: a push of some
// milliseconds moves a joint within a coarse count, and friction stops it there. T0 is the torque with which the reading came to
// stand. A joint that stands with the load balanced is never taken for stuck. A sensor that stops while the joint rests shows with the
// next motion.
#pragma once

#include <cstdint>

#include "daemon/realtime/joint/joint_loop_config.h"
#include "lcmtypes/reading_doubt.h"

namespace strainwave {

class PositionCheck {
 public:
  explicit PositionCheck(const JointLoopConfig& config) noexcept;

  /// Inertia and the largest static friction of the joint, of its gain table.
  void set_joint(double inertia_kgm2, double static_friction_Nm) noexcept {
    inertia_kgm2_ = inertia_kgm2;
    static_friction_Nm_ = static_friction_Nm;
  }

  /// One fresh reading at `now_ns` with the torque applied since the one before. Returns whether it can be
  /// true. With `driven` false the joint may be moved by hand and nothing is concluded from it.
  bool plausible(double position_rad, double torque_Nm, bool driven, std::int64_t now_ns) noexcept;
  /// Of the last reading, why it cannot be true; see lcmtypes/reading_doubt.h. 0: it can.
  std::uint32_t doubt() const noexcept { return doubt_; }

 private:
  bool jumped(double position_rad, double elapsed_s) const noexcept;
  bool stuck(double position_rad, double torque_Nm, double elapsed_s) noexcept;
  double elapsed_s(std::int64_t now_ns) const noexcept;
  void begin_stretch() noexcept;

  double period_s_;
  double overspeed_rad_s_;
  double count_rad_;
  double inertia_kgm2_ = 1.0;
  double static_friction_Nm_ = 0.0;
  double last_position_rad_ = 0.0;
  std::int64_t last_ns_ = 0;
  bool has_last_ = false;
  std::uint32_t doubt_ = 0;
  // Of the stretch without a change:
  int unchanged_periods_ = 0;
  double rest_torque_Nm_ = 0.0;       ///< T0
  double owed_velocity_rad_s_ = 0.0;  ///< that a joint must have by now, with its side
  double owed_motion_rad_ = 0.0;
};

}  // namespace strainwave
