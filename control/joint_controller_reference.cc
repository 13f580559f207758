// What JointController does to find out what the joint is to track: the samples of a stream, and each period the limits of the motion and
// its next sample.
#include <algorithm>
#include <cmath>
#include <utility>

#include "control/joint_controller.h"

namespace strainwave {

namespace {

// Share of the torque that the reference leaves to a joint that has fallen back: half of what drove it into chatter.
constexpr double kFallbackReserve = 0.5;
// A load that a stream told of fades to 1/e in this time once the stream is over: slower than the feedback takes it over.
constexpr double kForget_s = 0.5;

}  // namespace

void JointController::forget_told_load(int elapsed_periods) noexcept {
  if (streamed_ || phase_ != MotionPhase::kTracking) return;
  const double kept = std::exp(-elapsed_periods * config_.period_s / kForget_s);
  told_load_.torque_Nm *= kept;
  told_load_.inertia_kgm2 *= kept;
}

// A move that begins at rest, or goes on eased.
void JointController::ease() noexcept {
  if (!easing_ || jerk_limit_ || !shaper_.at_target() || !ordered_.at_target()) return;
  jerk_limit_ = easing_;
  jerk_limit_->reset(shaper_.position_rad(), 0.0);
  ordered_jerk_ = easing_;
  ordered_jerk_->reset(ordered_.position_rad(), 0.0);
}

// A stream tells how it moves by itself.
void JointController::end_easing() noexcept {
  if (!easing_ || !jerk_limit_) return;
  shaper_.restart(jerk_limit_->position_rad(), jerk_limit_->velocity_rad_s());
  ordered_.restart(ordered_jerk_->position_rad(), ordered_jerk_->velocity_rad_s());
  jerk_limit_.reset();
  ordered_jerk_.reset();
}

void JointController::follow(const StreamSample& sample, bool begins, double speed_limit_rad_s,
                             const PositionRange& range, OnTime on_time) noexcept {
  limit_speed(speed_limit_rad_s);
  end_easing();
  stream_range_ = range;
  on_time_ = on_time;
  if (!streamed_ || begins) {
    const double lead_s = on_time == OnTime::kJoint ? stream_lead_s() : 0.0;
    if (!begins && stream_.ended())
      stream_.resume(shaper_.position_rad(), shaper_.velocity_rad_s(), told_load_);
    else
      stream_.begin(shaper_.position_rad(), shaper_.velocity_rad_s(), lead_s / config_.period_s, told_load_);
    plans_ = 0;
    confined_ = ordered_confined_ = 0;
  }
  streamed_ = true;
  sample_position_rad_ = sample.position_rad;
  stream_.take(sample,
               {motion_.velocity_rad_s, std::min(motion_.acceleration_rad_s2, motion_.deceleration_rad_s2)});
}

double JointController::stream_lead_s() const noexcept {
  if (!config_.use_shaping) return 0.0;
  // Without a model of the joint the law follows the reading of now.
  const double delay_s = observing() || linked() ? config_.delay_periods * config_.period_s : 0.0;
  const double jerk_s = jerk_limit_ ? jerk_limit_->lag_s() : 0.0;
  return delay_s + jerk_s + (linked() ? 0.5 * link_motion_->spread_s() : 0.0);
}

void JointController::advance_reference(int elapsed_periods) noexcept {
  forget_told_load(elapsed_periods);
  if (!streamed_) stream_.wait(elapsed_periods);
  if (linked()) return advance_link(elapsed_periods);
  if (!config_.use_shaping) {
    if (streamed_) {
      const MovingTarget target = stream_.step();
      told_load_ = target.load;
      shaper_.set_target(target.next_position_rad);
      ordered_.set_target(shaper_.target_rad());
    }
    shaper_.jump();
    ordered_.jump();
    reference_ = {shaper_.target_rad(), 0.0, 0.0};
    ordered_reference_ = reference_;
    return;
  }
  for (int period = 0; period < elapsed_periods; ++period) {
    // The last of them begins anew, if one has to: it is where the joint is now.
    if (replan_ && period == elapsed_periods - 1) {
      const double fastest = config_.motion.velocity_rad_s;
      begin_plan(state_.then().position_rad, std::clamp(state_.then().velocity_rad_s, -fastest, fastest));
      ++replans_;
      replan_ = false;
      const int side = state_.then().position_rad > shaper_.target_rad() ? 1 : -1;
      turned_back_ = !streamed_ && std::exchange(plan_side_, side) == -side;
    }
    limit_reference(shaper_);
    limit_reference(ordered_);
    advance_references();
  }
}

MotionLimits JointController::present_limits(double speed_rad_s) const noexcept {
  const double reserve =
      fallen_back() ? std::max(kFallbackReserve, config_.torque_reserve) : config_.torque_reserve;
  JointDisturbance disturbance = state_.now().disturbance;
  disturbance.load_Nm += config_.gravity.at(reference_.position_rad) + told_load_.torque_Nm;
  const auto with_reserve = [&](double share) {
    return reachable_limits(motion_, config_.motor, state_.model(), disturbance, torque_limit_Nm_, share,
                            speed_rad_s, config_.period_s);
  };
  MotionLimits limits = with_reserve(reserve);
  if (fallen_back()) {
    // A motion that brakes already goes on to, or it would end far beyond its target.
    const double left_rad = std::abs(shaper_.target_rad() - shaper_.position_rad());
    const double needed_rad_s2 = 0.5 * speed_rad_s * speed_rad_s / left_rad;
    const double hardest_rad_s2 = with_reserve(config_.torque_reserve).deceleration_rad_s2;
    limits.deceleration_rad_s2 =
        std::max(limits.deceleration_rad_s2, std::min(needed_rad_s2, hardest_rad_s2));
  }
  if (!linked()) return limits;
  limits.acceleration_rad_s2 *= link_share_;
  limits.deceleration_rad_s2 *= link_share_;
  return limits;
}

// What the joint can do at the speed that the reference has reached.
void JointController::limit_reference(ReferenceShaper& shaper) const noexcept {
  shaper.set_limits(present_limits(std::abs(shaper.velocity_rad_s())));
}

void JointController::advance_references() noexcept {
  const auto smooth = [](std::optional<JerkLimit>& limit, const Reference& planned) {
    return limit ? limit->step(planned) : planned;
  };
  if (!streamed_) {
    reference_ = smooth(jerk_limit_, shaper_.step());
    ordered_reference_ = smooth(ordered_jerk_, ordered_.step());
    return;
  }
  const double last_target_rad = shaper_.target_rad();
  const MovingTarget target = stream_.step();
  told_load_ = target.load;
  const auto follow = [&](ReferenceShaper& shaper, StreamTarget::Confinement& way) {
    return shaper.follow(stream_.confined(target, shaper.position_rad(), shaper.velocity_rad_s(), way),
                         stream_range_);
  };
  reference_ = smooth(jerk_limit_, follow(shaper_, confined_));
  ordered_reference_ = smooth(ordered_jerk_, follow(ordered_, ordered_confined_));
  if (shaper_.target_rad() != last_target_rad) {
    corrections_.reset();
    new_target();
  }
  if (stream_.ended()) {
    streamed_ = false;
    shaper_.stop();
    ordered_.stop();
  }
}

}  // namespace strainwave
