// What JointController does to find out what the joint is to track: the samples of a stream, and each period the limits of the motion and
// its next sample.
#include <algorithm>
#include <cmath>

#include "control/joint_controller.h"

namespace strainwave {

namespace {

// Share of the torque that the reference leaves to a joint that has fallen back: half of what drove it into chatter.
constexpr double kFallbackReserve = 0.5;
// A load that a stream told of fades to 1/e in this time once the stream is over: slower than the feedback takes it over.
constexpr double kForget_s = 0.5;
// What has stood for a shorter time on a path turns, and has not come to rest.
constexpr double kTurns_s = 0.06;

}  // namespace

void JointController::forget_told_load(int elapsed_periods) noexcept {
  if (streamed() || phase_ != MotionPhase::kTracking) return;
  const double kept = std::exp(-elapsed_periods * config_.period_s / kForget_s);
  told_load_.torque_Nm *= kept;
  told_load_.inertia_kgm2 *= kept;
}

// A move that begins at rest, or goes on eased.
void JointController::ease() noexcept {
  if (!plan_.wants_easing() || !ordered_.wants_easing()) return;
  plan_.ease();
  ordered_.ease();
}

void JointController::follow(const StreamSample& sample, bool begins, double speed_limit_rad_s,
                             const PositionRange& range, OnTime on_time) noexcept {
  limit_speed(speed_limit_rad_s);
  stream_range_ = range;
  if (!streamed() || begins) {
    const bool resumes = !begins && stream_.ended();
    // One that takes over an eased move on the way goes on eased, and ahead by what that takes: else the acceleration would step. A path
    // begins at rest, and is as late as that makes it.
    if (on_time == OnTime::kPlan) {
      plan_.begin_path();
      ordered_.begin_path();
    } else if (!resumes && plan_.rests() && ordered_.rests()) {
      plan_.end_easing();
      ordered_.end_easing();
    }
    const double lead = on_time == OnTime::kJoint ? stream_lead_s() / config_.period_s : 0.0;
    if (resumes && stream_.lead_periods() == lead)
      stream_.resume(plan_.position_rad(), plan_.velocity_rad_s(), told_load_);
    else
      stream_.begin(plan_.position_rad(), plan_.velocity_rad_s(), lead, told_load_);
    new_plans_.new_phase();
    confined_ = ordered_confined_ = 0;
  }
  follows_ = on_time == OnTime::kJoint ? Follows::kStreamOnTime : Follows::kStreamLater;
  sample_position_rad_ = sample.position_rad;
  StreamSample taken = sample;
  taken.computed_here = on_time == OnTime::kPlan;
  stream_.take(taken,
               {motion_.velocity_rad_s, std::min(motion_.acceleration_rad_s2, motion_.deceleration_rad_s2)});
}

bool JointController::turns() const noexcept {
  return !linked() && follows_ == Follows::kStreamLater && reference_rest_s_ < kTurns_s;
}

// Through what it left out step() goes as if it had been there; not where nobody knows what the joint did.
void JointController::begin_period(std::int64_t elapsed_periods) noexcept {
  if (elapsed_periods <= kMaxElapsedPeriods)
    stream_.leave_out(elapsed_periods - 1);
  else if (streamed())
    stream_.skip(elapsed_periods - 1);
  else
    stream_.wait(elapsed_periods - 1);
}

double JointController::stream_lead_s() const noexcept {
  return config_.use_shaping ? plan_.lag_s() + ahead_of_joint_s() : 0.0;
}

double JointController::plan_lead_s() const noexcept {
  return config_.use_shaping ? plan_.path_lag_s() + ahead_of_joint_s() : 0.0;
}

double JointController::reference_lag_s() const noexcept {
  if (!config_.use_shaping) return 0.0;
  // A motor before its link is told where it is read now: its plan has the delay behind it.
  return plan_.path_lag_s() + (linked() ? ahead_of_joint_s() : 0.0);
}

double JointController::spread_lag_s() const noexcept {
  return linked() ? 0.5 * link_motion_->spread_s() : 0.0;
}

double JointController::ahead_of_joint_s() const noexcept {
  // Without a model of the joint the law follows the reading of now.
  const double delay_s = observing() || linked() ? config_.delay_periods * config_.period_s : 0.0;
  return delay_s + spread_lag_s();
}

void JointController::advance_reference(int elapsed_periods) noexcept {
  forget_told_load(elapsed_periods);
  if (!streamed()) stream_.wait(elapsed_periods);
  if (linked()) return advance_link(elapsed_periods);
  if (!config_.use_shaping) {
    if (streamed()) {
      const MovingTarget target = stream_.step();
      told_load_ = target.load;
      plan_.set_target(target.next_position_rad);
      ordered_.set_target(plan_.target_rad());
    }
    plan_.jump();
    ordered_.jump();
    reference_ = {plan_.target_rad(), 0.0, 0.0};
    ordered_reference_ = reference_;
    return;
  }
  for (int period = 0; period < elapsed_periods; ++period) {
    // The last of them begins anew, if one has to: it is where the joint is now.
    if (new_plans_.due() && period == elapsed_periods - 1) {
      const double fastest = config_.motion.velocity_rad_s;
      plan_.go_on_from(state_.then().position_rad,
                       std::clamp(state_.then().velocity_rad_s, -fastest, fastest));
      ++replans_;
      corrects_ = true;
      const int side = state_.then().position_rad > plan_.target_rad() ? 1 : -1;
      signs_.turned_back = new_plans_.begin(streamed() ? 0 : side);
    }
    limit_reference(plan_);
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
    const double left_rad = std::abs(plan_.target_rad() - plan_.position_rad());
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
void JointController::limit_reference(ReferencePlan& plan) const noexcept {
  plan.set_limits(present_limits(std::abs(plan.velocity_rad_s())));
}

void JointController::advance_references() noexcept {
  if (!streamed()) {
    reference_ = plan_.step();
    ordered_reference_ = ordered_.step();
    return;
  }
  const double last_target_rad = plan_.target_rad();
  const MovingTarget target = stream_.step();
  told_load_ = target.load;
  const auto follow = [&](ReferencePlan& plan, StreamTarget::Confinement& way) {
    return plan.follow(stream_.confined(target, plan.position_rad(), plan.velocity_rad_s(), way),
                       stream_range_);
  };
  reference_ = follow(plan_, confined_);
  ordered_reference_ = follow(ordered_, ordered_confined_);
  if (plan_.target_rad() != last_target_rad) {
    corrections_.reset();
    new_target();
  }
  if (stream_.ended()) {
    follows_ = Follows::kTarget;
    plan_.stop();
    ordered_.stop();
  }
}

}  // namespace strainwave
