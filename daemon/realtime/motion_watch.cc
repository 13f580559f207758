#include "daemon/realtime/motion_watch.h"

#include <cmath>

namespace strainwave {

namespace {

/// A motion that falls behind is planned anew a few times, when friction or load turn out otherwise than thought.
constexpr int kReplans = 50;
constexpr std::int64_t kReplanWindow_ns = 1'000'000'000;

}  // namespace

void MotionWatch::begin(std::int64_t now_ns) noexcept {
  push_ = 0.0;
  light_ns_ = now_ns;
  replans_since_ns_ = now_ns;
  replans_before_ = 0;
}

Fault MotionWatch::judge(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept {
  // Each looks every period, whatever the others find.
  const bool stands = blocked(motion, joint_position_rad, now_ns);
  const bool restless = planned_too_often(motion.replans, now_ns);
  const bool heavy = overloaded(motion.estimate.disturbance.load_Nm, now_ns);
  if (std::abs(motion.ordered_reference.position_rad - joint_position_rad) > config_.following_error_rad)
    return Fault::kFollowingError;
  if (stands || restless) return Fault::kBlocked;
  return heavy ? Fault::kOverload : Fault::kNone;
}

bool MotionWatch::blocked(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept {
  const double torque_Nm = motion.output.torque_Nm;
  const double push = motion.output.saturated && torque_Nm != 0.0 ? std::copysign(1.0, torque_Nm) : 0.0;
  const double progress_rad = push * (joint_position_rad - push_from_rad_);
  if (push == 0.0 || push != push_ || progress_rad >= config_.progress_rad_s * config_.blocked_s) {
    push_ = push;
    push_from_rad_ = joint_position_rad;
    push_since_ns_ = now_ns;
  }
  return push_ != 0.0 && lasts(push_since_ns_, now_ns);
}

bool MotionWatch::planned_too_often(int replans, std::int64_t now_ns) noexcept {
  if (replans - replans_before_ > kReplans) return true;
  if (now_ns - replans_since_ns_ >= kReplanWindow_ns) {
    replans_since_ns_ = now_ns;
    replans_before_ = replans;
  }
  return false;
}

bool MotionWatch::overloaded(double load_Nm, std::int64_t now_ns) noexcept {
  if (std::abs(load_Nm) <= config_.load_Nm) light_ns_ = now_ns;
  return lasts(light_ns_, now_ns);
}

}  // namespace strainwave
