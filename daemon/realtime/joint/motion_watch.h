// SPDX-License-Identifier: BSD-3-Clause
// Supervises whether the joint follows its orders. Compares it with the reference from the orders alone, which does not change when
// the plan is made anew for a joint that fell behind. Real-time safe; time is an argument.
//
//   following    |ordered reference - position| > following_error_rad                                -> kFollowingError
//   blocked      torque at its limit in vain: the joint neither moves in its direction, at
//                standstill_rad_s, nor is braked by it; for blocked_s in total, minus a tenth of the
//                time without blocking                                                               -> kBlocked
//   load         |estimated load| > load_Nm for overload_s, or a joint yields for 0.5 s              -> kOverload
//   high load    |estimated load| > notice_Nm                                                        no fault, a notice
//   off target   |place to hold - position| > rest_tolerance_rad, at least two counts, for a second  no fault, a notice
#pragma once

#include <cstdint>
#include <optional>

#include "base/durations.h"
#include "control/joint_controller.h"
#include "daemon/realtime/joint/joint_loop_config.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

class MotionWatch {
 public:
  /// `config` outlives this object.
  explicit MotionWatch(const JointLoopConfig& config) noexcept : config_(config) {}

  /// Sets the load limits. Call it before the control law begins, and with every new table.
  void limit_loads(const LoadLimits& loads) noexcept { loads_ = loads; }
  const LoadLimits& loads() const noexcept { return loads_; }
  /// The control law begins: forgets everything except the time for which the joint was pushed in vain.
  void begin(double joint_position_rad, std::int64_t now_ns) noexcept;
  /// Checks one period under control. Returns the resulting fault, or kNone.
  Fault judge(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept;
  /// After judge(): whether the load is above notice_Nm.
  bool high_load() const noexcept { return high_load_; }
  /// Whether the joint yielded within the half second before now.
  bool has_just_yielded(std::int64_t now_ns) const noexcept;
  /// Mean load over half a second, while the load was not high.
  double usual_load_Nm() const noexcept { return usual_load_Nm_; }
  /// Checks one period. True if the joint has been `holding` too far off its place for a second. `distance_rad`: position minus place.
  bool off_target(bool holding, double distance_rad, std::int64_t now_ns) noexcept;

 private:
  bool blocked(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept;
  bool pushed_in_vain(double direction, double moved_rad) const noexcept;
  void begin_span(double joint_position_rad, std::int64_t now_ns) noexcept;
  double span_s() const noexcept;
  bool overloaded(const JointStep& motion, std::int64_t now_ns) noexcept;

  const JointLoopConfig& config_;
  LoadLimits loads_;
  double pushed_s_ = 0.0;  ///< in this span, at the torque limit; signed like the torque
  double in_vain_s_ = 0.0;
  double span_from_rad_ = 0.0;     ///< where the joint was when the span began
  double moved_before_rad_ = 0.0;  ///< in the previous span
  std::int64_t span_since_ns_ = 0;
  std::int64_t looked_ns_ = 0;  ///< when the torque was last looked at
  std::int64_t light_ns_ = 0;   ///< when the load was last within its bound
  std::int64_t judged_ns_ = 0;  ///< the last period
  std::int64_t yields_since_ns_ = 0;
  std::optional<std::int64_t> yielded_ns_;  ///< the last period in which the joint yielded
  double usual_load_Nm_ = 0.0;
  bool high_load_ = false;
  std::int64_t in_place_ns_ = 0;  ///< when the joint was last in its place, or not holding
};

}  // namespace strainwave
