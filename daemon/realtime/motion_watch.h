// Whether the joint does what it was ordered to. Supervises against the reference that the orders alone make, which no new plan
// of a joint that fell behind touches. Real-time safe; time is an argument.
//
//   following    |ordered reference - position| > following_error_rad                                -> kFollowingError
//   blocked      torque at its limit for blocked_s, and in its direction the joint has come less far
//                than progress_rad_s * blocked_s                                                     -> kBlocked
//   replanned    more than kReplans new plans within a second                                        -> kBlocked
//   load         |estimated load| > load_Nm for blocked_s                                            -> kOverload
#pragma once

#include <cstdint>

#include "base/durations.h"
#include "control/joint_controller.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

struct MotionWatchConfig {
  double following_error_rad = 0.0;  ///< > 0
  double load_Nm = 0.0;              ///< > 0
  double blocked_s = 0.5;            ///< > 0
  double progress_rad_s = 0.01;      ///< > 0; slower is no progress
};

class MotionWatch {
 public:
  explicit MotionWatch(const MotionWatchConfig& config) noexcept : config_(config) {}

  /// The control law begins: nothing is remembered.
  void begin(std::int64_t now_ns) noexcept;
  /// One period under control. The fault that it makes, or kNone.
  Fault judge(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept;

 private:
  bool blocked(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept;
  bool planned_too_often(int replans, std::int64_t now_ns) noexcept;
  bool overloaded(double load_Nm, std::int64_t now_ns) noexcept;
  bool lasts(std::int64_t since_ns, std::int64_t now_ns) const noexcept {
    return seconds(now_ns - since_ns) >= config_.blocked_s;
  }

  MotionWatchConfig config_;
  double push_ = 0.0;           ///< direction of the torque at its limit; 0: it is not there
  double push_from_rad_ = 0.0;  ///< where the joint was
  std::int64_t push_since_ns_ = 0;
  std::int64_t light_ns_ = 0;  ///< when the load was last within its bound
  std::int64_t replans_since_ns_ = 0;
  int replans_before_ = 0;
};

}  // namespace strainwave
