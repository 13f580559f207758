// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/motion_watch.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

/// Length of a span in which a push is judged: a joint that reverses under a push stands still for less.
constexpr double kSpan_s = 0.02;
/// Share of the time without blocking that is forgotten. A joint that is blocked for a tenth of the time has an RMS torque of a third of
/// its limit. That is the continuous torque of such motors (11 of 34 N.m, data/rhs17_datasheet.csv).
constexpr double kForgets = 0.1;
/// Least share of a span at the torque limit for the span to count; time at the opposite limit is subtracted. With flickering readings
/// the torque leaves the limit for single periods.
constexpr double kPushed = 0.5;
/// A smaller deviation is within the encoder's resolution.
constexpr double kCountsOffTarget = 2.0;
/// Correcting the last count takes less, whether or not it succeeds.
constexpr double kOffTarget_s = 1.0;
/// A wall of 200 N.m/rad pushes a joint out in 70 ms; the joint then coasts and swings for some 0.3 s. A longer push is not a blow. The
/// load that a joint carries is the mean over the same time.
constexpr double kLongestBlow_s = 0.5;

}  // namespace

void MotionWatch::begin(double joint_position_rad, std::int64_t now_ns) noexcept {
  in_vain_s_ = std::clamp(in_vain_s_ - kForgets * seconds(now_ns - looked_ns_), 0.0, config_.blocked_s);
  looked_ns_ = now_ns;
  begin_span(joint_position_rad, now_ns);
  moved_before_rad_ = 0.0;
  light_ns_ = now_ns;
  judged_ns_ = now_ns - nanoseconds(kLongestBlow_s);  // the first load counts fully
  yields_since_ns_ = now_ns;
  yielded_ns_.reset();
  high_load_ = false;
  in_place_ns_ = now_ns;
}

Fault MotionWatch::judge(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept {
  // Both checks must run every period, whatever the other one finds.
  const bool stands = blocked(motion, joint_position_rad, now_ns);
  const bool heavy = overloaded(motion, now_ns);
  if (std::abs(motion.ordered_reference.position_rad - joint_position_rad) >
      config_.limits.following_error_rad)
    return Fault::kFollowingError;
  if (stands) return Fault::kBlocked;
  return heavy ? Fault::kOverload : Fault::kNone;
}

// Whether a span at the torque limit had no effect: a free joint would move in `direction`, or slow down against it.
bool MotionWatch::pushed_in_vain(double direction, double moved_rad) const noexcept {
  const double progress_rad = config_.standstill_rad_s * span_s();
  return direction * moved_rad < progress_rad && direction * (moved_rad - moved_before_rad_) < progress_rad;
}

void MotionWatch::begin_span(double joint_position_rad, std::int64_t now_ns) noexcept {
  span_since_ns_ = now_ns;
  span_from_rad_ = joint_position_rad;
  pushed_s_ = 0.0;
}

double MotionWatch::span_s() const noexcept {
  return std::min(kSpan_s, config_.blocked_s);
}

bool MotionWatch::blocked(const JointStep& motion, double joint_position_rad, std::int64_t now_ns) noexcept {
  const double torque_Nm = motion.output.torque_Nm;
  if (motion.output.saturated && torque_Nm != 0.0)
    pushed_s_ += std::copysign(seconds(now_ns - looked_ns_), torque_Nm);
  looked_ns_ = now_ns;
  const double passed_s = seconds(now_ns - span_since_ns_);
  if (passed_s < span_s()) return false;
  const double direction = std::copysign(1.0, pushed_s_);
  const double moved_rad = joint_position_rad - span_from_rad_;
  const bool in_vain = std::abs(pushed_s_) >= kPushed * passed_s && pushed_in_vain(direction, moved_rad);
  in_vain_s_ = std::max(0.0, in_vain_s_ + (in_vain ? std::abs(pushed_s_) : -kForgets * passed_s));
  begin_span(joint_position_rad, now_ns);
  moved_before_rad_ = moved_rad;
  return in_vain && in_vain_s_ > config_.blocked_s - 0.5 * span_s();
}

bool MotionWatch::off_target(bool holding, double distance_rad, std::int64_t now_ns) noexcept {
  const double tolerance_rad =
      std::max(config_.rest_tolerance_rad, kCountsOffTarget * config_.controller.encoder_resolution_rad);
  if (!holding || std::abs(distance_rad) <= tolerance_rad) in_place_ns_ = now_ns;
  return seconds(now_ns - in_place_ns_) >= kOffTarget_s;
}

bool MotionWatch::has_just_yielded(std::int64_t now_ns) const noexcept {
  return yielded_ns_ && seconds(now_ns - *yielded_ns_) < kLongestBlow_s;
}

bool MotionWatch::overloaded(const JointStep& motion, std::int64_t now_ns) noexcept {
  const double load_Nm = motion.load_Nm;
  high_load_ = std::abs(load_Nm) > loads_.notice_Nm;
  const double share = std::min(1.0, seconds(now_ns - judged_ns_) / kLongestBlow_s);
  judged_ns_ = now_ns;
  if (!high_load_) usual_load_Nm_ += share * (load_Nm - usual_load_Nm_);
  const bool yields = motion.phase == MotionPhase::kYielding;
  if (yields || std::abs(load_Nm) <= loads_.load_Nm) light_ns_ = now_ns;
  if (yields)
    yielded_ns_ = now_ns;
  else
    yields_since_ns_ = now_ns;
  return seconds(now_ns - light_ns_) > config_.overload_s ||
         seconds(now_ns - yields_since_ns_) > kLongestBlow_s;
}

}  // namespace strainwave
