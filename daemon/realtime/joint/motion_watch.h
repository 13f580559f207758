// SPDX-License-Identifier: BSD-3-Clause
// Whether the joint does what it was ordered to. Supervises against the reference that the orders alone make, which no new plan
// of a joint that fell behind touches. Real-time safe; time is an argument.
//
//   following    |ordered reference - position| > following_error_rad                                -> kFollowingError
//   blocked      torque at its limit in vain: the joint neither gets on in its direction, by
//                standstill_rad_s, nor is braked by it; for blocked_s in all, of which a tenth of the
//                time that it was otherwise is forgotten                                             -> kBlocked
//   load         |load that shows| > load_Nm for overload_s, or a joint yields for 0.5 s             -> kOverload
//   high load    |load that shows| > notice_Nm                                                       no fault, a notice
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

  /// Before the control law begins, and with every table.
  void limit_loads(const LoadLimits& loads) noexcept { loads_ = loads; }
  const LoadLimits& loads() const noexcept { return loads_; }
  /// The control law begins: nothing is remembered but how long the joint was pushed in vain.
  void begin(double joint_position_rad, std::int64_t now_ns) noexcept;
  /// One period under control. The fault that it makes, or kNone.
  Fault judge(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept;
  /// After judge(): whether the load is above what calls for a notice.
  bool high_load() const noexcept { return high_load_; }
  /// Whether the joint yielded within the half second before now.
  bool has_just_yielded(std::int64_t now_ns) const noexcept;
  /// What the joint carried, in the mean over half a second, while the load was not high.
  double usual_load_Nm() const noexcept { return usual_load_Nm_; }
  /// One period more in which the joint holds (else it is not `holding`), by so much off its place: whether that has lasted.
  bool off_target(bool holding, double distance_rad, std::int64_t now_ns) noexcept;

 private:
  bool blocked(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept;
  bool pushed_in_vain(double direction, double moved_rad) const noexcept;
  void begin_span(double joint_position_rad, std::int64_t now_ns) noexcept;
  double span_s() const noexcept;
  bool overloaded(const JointStep& motion, std::int64_t now_ns) noexcept;

  const JointLoopConfig& config_;
  LoadLimits loads_;
  double pushed_s_ = 0.0;  ///< of this span, at the torque limit; of the torque's sign
  double in_vain_s_ = 0.0;
  double span_from_rad_ = 0.0;     ///< where the joint was when the span began
  double moved_before_rad_ = 0.0;  ///< in the span before
  std::int64_t span_since_ns_ = 0;
  std::int64_t looked_ns_ = 0;  ///< when the torque was last looked at
  std::int64_t light_ns_ = 0;   ///< when the load was last within its bound
  std::int64_t judged_ns_ = 0;  ///< the last period
  std::int64_t yields_since_ns_ = 0;
  std::optional<std::int64_t> yielded_ns_;  ///< the last period in which it did
  double usual_load_Nm_ = 0.0;
  bool high_load_ = false;
  std::int64_t in_place_ns_ = 0;  ///< when the joint was last where it is to hold, or not holding
};

}  // namespace strainwave
