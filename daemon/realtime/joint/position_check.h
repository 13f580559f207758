// SPDX-License-Identifier: BSD-3-Clause
// Checks whether a position reading is plausible, by two tests from mechanics alone. Real-time safe.
//
// Jump: between two readings the joint cannot have moved faster than twice its overspeed limit.
//
// Stuck: a joint at rest under a constant load L and torque T0 has |T0 - L| <= Fs. When the torque
// then becomes T, at least |T - T0| - 2 Fs of it accelerates the joint, whatever L is:
//     displacement >= integral integral max(0, |T - T0| - 2 Fs) / J  dt dt
// A sensor is stuck if it shows no change although this displacement is many counts; opposite displacements cancel. Fewer counts prove
// nothing: a push of some milliseconds moves a joint within a coarse count, and friction stops it there. T0 is the torque when the
// reading stopped changing. A joint at rest with a balanced load never counts as stuck. A sensor that fails at rest is detected in the
// next motion.
#pragma once

#include <cstdint>

#include "daemon/realtime/joint/joint_loop_config.h"
#include "lcmtypes/reading_doubt.h"

namespace strainwave {

class PositionCheck {
 public:
  explicit PositionCheck(const JointLoopConfig& config) noexcept;

  /// Inertia and largest static friction of the joint.
  void set_joint(double inertia_kgm2, double static_friction_Nm) noexcept {
    inertia_kgm2_ = inertia_kgm2;
    static_friction_Nm_ = static_friction_Nm;
  }

  /// Checks one fresh reading at `now_ns`, with the torque applied since the previous one. Returns whether it is
  /// plausible. With `driven` false, the joint may be moved by hand, and every reading is plausible.
  bool plausible(double position_rad, double torque_Nm, bool driven, std::int64_t now_ns) noexcept;
  /// Why the last reading is implausible, see lcmtypes/reading_doubt.h; 0: it is plausible.
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
  // For the present stretch without a change:
  int unchanged_periods_ = 0;
  double rest_torque_Nm_ = 0.0;       ///< T0
  double owed_velocity_rad_s_ = 0.0;  ///< least velocity that a free joint has by now, signed
  double owed_motion_rad_ = 0.0;
};

}  // namespace strainwave
