// SPDX-License-Identifier: BSD-3-Clause
#include "control/trajectory/motor_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace strainwave {

namespace {

// On a spring each mean lasts at least one period: otherwise the acceleration steps.
constexpr int kLeastSpread = 2;
// Rest periods of a plan that begins at rest, and about the largest number that is counted.
constexpr int kEver = std::numeric_limits<int>::max() / 2;
// Share of the way to the motion by which the model yields in a period.
constexpr double kYield = 0.2;

// sqrt(8) / w, with w for the secant stiffness at half the torque that the hardest acceleration transmits; 0 without a spring.
double swing_periods(const MotorPlannerConfig& c) noexcept {
  const LinkModel& joint = c.joint;
  if (joint.rigid()) return 0.0;
  const double transmitted_Nm =
      c.torque_limit_Nm * joint.link_inertia_kgm2 / (joint.motor_inertia_kgm2 + joint.link_inertia_kgm2);
  const double stiffness = joint.spring.secant_Nm_rad(0.5 * transmitted_Nm);
  const double swing_rad_s =
      free_free_frequency_rad_s(joint.motor_inertia_kgm2, joint.link_inertia_kgm2, stiffness);
  return std::sqrt(8.0) / swing_rad_s / c.period_s;
}

double hardest_rad_s2(const MotionLimits& limits) noexcept {
  return std::max(limits.acceleration_rad_s2, limits.deceleration_rad_s2);
}

int whole_spread(const MotorPlannerConfig& c) noexcept {
  const int least = c.joint.rigid() ? 0 : kLeastSpread;
  const int swing = std::clamp(static_cast<int>(std::ceil(swing_periods(c))), least, 2 * kMaxMeanPeriods);
  if (!c.jerk_limit_rad_s3) return swing;
  const double jerk_periods =
      4.0 * hardest_rad_s2(MotorPlanner::possible_limits(c)) / *c.jerk_limit_rad_s3 / c.period_s;
  return std::clamp(static_cast<int>(std::ceil(jerk_periods)), swing, 2 * kMaxMeanPeriods);
}

}  // namespace

MotionLimits MotorPlanner::possible_limits(const MotorPlannerConfig& config) noexcept {
  MotionLimits limits = config.motion;
  if (!config.jerk_limit_rad_s3) return limits;
  const double most_rad_s2 = 0.25 * *config.jerk_limit_rad_s3 * 2 * kMaxMeanPeriods * config.period_s;
  limits.acceleration_rad_s2 = std::min(limits.acceleration_rad_s2, most_rad_s2);
  limits.deceleration_rad_s2 = std::min(limits.deceleration_rad_s2, most_rad_s2);
  return limits;
}

MotorPlanner::MotorPlanner(const MotorPlannerConfig& config) noexcept
    : config_(config),
      gains_(config.joint.rigid() ? LinkGains{}
                                  : config.joint.regulate(config.torque_limit_Nm, config.period_s)),
      spread_periods_(whole_spread(config)),
      first_(spread_periods_ / 2, config.period_s),
      second_(spread_periods_ - spread_periods_ / 2, config.period_s) {
  assert(config.delay_periods >= 0 && config.delay_periods <= kMaxControlDelay);
  reset(0.0);
}

double MotorPlanner::reset(double motor_position_rad, double velocity_rad_s) noexcept {
  // Gravity hardly changes over its own wind-up: each round reduces the error to about a thousandth.
  double position_rad = motor_position_rad;
  for (int round = 0; round < 3; ++round) position_rad -= motor_rest_rad(position_rad) - motor_position_rad;
  // The plan leads the reading by the delay.
  position_rad += config_.delay_periods * config_.period_s * velocity_rad_s;
  const double between_rad = position_rad + second_.lag_s() * velocity_rad_s;
  const double planned_rad = between_rad + first_.lag_s() * velocity_rad_s;
  first_.reset(planned_rad, velocity_rad_s);
  second_.reset(between_rad, velocity_rad_s);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    // The newest state is one period old; the first step() adds `next_` in front of it.
    const double ago_s = static_cast<double>(i + 1) * config_.period_s;
    states_[i] = flat({position_rad - ago_s * velocity_rad_s, velocity_rad_s, 0.0, 0.0}, 0.0);
  }
  wanted_ = flat({position_rad, velocity_rad_s, 0.0, 0.0}, 0.0);
  jerk_rad_s3_ = 0.0;
  next_ = wanted_;
  rest_periods_ = velocity_rad_s == 0.0 ? kEver : 0;
  return planned_rad;
}

LinkState MotorPlanner::flat(const MotionPoint& link, double snap_rad_s4) const noexcept {
  const LinkModel& joint = config_.joint;
  const double held_Nm = joint.gravity.at(link.position_rad);
  const double slope_Nm_rad = joint.gravity.slope_at(link.position_rad);
  const double transmitted_Nm = joint.link_inertia_kgm2 * link.acceleration_rad_s2 + held_Nm;
  const double rate_Nm_s = joint.link_inertia_kgm2 * link.jerk_rad_s3 + slope_Nm_rad * link.velocity_rad_s;
  const double change_Nm_s2 = joint.link_inertia_kgm2 * snap_rad_s4 + slope_Nm_rad * link.acceleration_rad_s2;
  const double compliance = joint.spring.compliance_rad_Nm(transmitted_Nm);
  const double speed_rad_s = compliance * (rate_Nm_s - joint.damping_Nms_rad * compliance * change_Nm_s2);
  const double angle_rad = joint.spring.angle_rad(transmitted_Nm - joint.damping_Nms_rad * speed_rad_s);
  return {link.position_rad, link.velocity_rad_s, link.position_rad + angle_rad,
          link.velocity_rad_s + speed_rad_s};
}

// Advances the model by a period. The motion wants `wanted_Nm` and the state `wanted_end` at the period's end. The regulator corrects the
// error that this torque alone would leave there, from the last period and from this one.
void MotorPlanner::follow(double wanted_Nm, const LinkState& wanted_end, const TorqueRange& possible,
                          double taken_Nm) noexcept {
  if (rigid()) {
    torque_Nm_ = wanted_Nm;
    middle_velocity_rad_s_ = 0.5 * (wanted_.motor_velocity_rad_s + wanted_end.motor_velocity_rad_s);
    next_ = wanted_end;
    return;
  }
  const double asked_Nm =
      std::clamp(wanted_Nm, -config_.torque_limit_Nm - taken_Nm, config_.torque_limit_Nm - taken_Nm);
  const LinkState alone_end = config_.joint.advance(states_.front(), wanted_Nm, config_.period_s).end;
  const double back_Nm = regulated_torque_Nm(gains_, wanted_end, alone_end);
  torque_Nm_ = std::clamp(wanted_Nm + back_Nm, std::min(possible.min_Nm, asked_Nm),
                          std::max(possible.max_Nm, asked_Nm));
  exhausted_ = wanted_Nm + back_Nm != torque_Nm_;
  regulates_ = std::abs(back_Nm) > std::abs(wanted_Nm);
  const LinkModel::Period period = config_.joint.advance(states_.front(), torque_Nm_, config_.period_s);
  next_ = period.end;
  middle_velocity_rad_s_ = period.middle_velocity_rad_s;
}

// The motion has ended: once the model is within the tolerance of its end, it stands still.
void MotorPlanner::settle() noexcept {
  const double slow_rad_s = 0.5 * config_.tolerance_rad / config_.period_s;
  const bool there =
      std::abs(next_.link_position_rad - wanted_.link_position_rad) < config_.tolerance_rad &&
      std::abs(next_.motor_position_rad - wanted_.motor_position_rad) < config_.tolerance_rad &&
      std::abs(next_.link_velocity_rad_s) < slow_rad_s && std::abs(next_.motor_velocity_rad_s) < slow_rad_s;
  if (there) next_ = wanted_;
}

MotorPlan MotorPlanner::plan() noexcept {
  const double h = config_.period_s;
  const LinkState& begin = states_.front();
  const auto delay = static_cast<std::size_t>(config_.delay_periods);
  MotorPlan plan;
  plan.position_rad = states_[delay].motor_position_rad;
  plan.velocity_rad_s = (plan.position_rad - states_[delay + 1].motor_position_rad) / h;
  plan.link_position_rad = states_[delay].link_position_rad;
  plan.torque_Nm = torque_Nm_;
  plan.acting_velocities_rad_s = {begin.motor_velocity_rad_s, middle_velocity_rad_s_,
                                  next_.motor_velocity_rad_s};
  plan.acting_acceleration_rad_s2 = (next_.motor_velocity_rad_s - begin.motor_velocity_rad_s) / h;
  plan.acting_end_position_rad = next_.motor_position_rad;
  const bool rests = begin.motor_velocity_rad_s == 0.0 && next_.motor_velocity_rad_s == 0.0 &&
                     next_.motor_position_rad == begin.motor_position_rad;
  rest_periods_ = rests ? std::min(rest_periods_, kEver) + 1 : 0;
  return plan;
}

// The planned sample gives the end of the period that begins now, and so the state of the joint there.
MotorPlan MotorPlanner::step(const Reference& planned, const TorqueRange& possible,
                             double taken_Nm) noexcept {
  const double h = config_.period_s;
  const LinkModel& joint = config_.joint;
  const MotionPoint end{
      planned.position_rad + h * (planned.velocity_rad_s + 0.5 * h * planned.acceleration_rad_s2),
      planned.velocity_rad_s + h * planned.acceleration_rad_s2, planned.acceleration_rad_s2, 0.0};
  std::copy_backward(states_.begin(), states_.end() - 1, states_.end());
  states_.front() = next_;
  const MotionPoint link = second_.step(first_.step(end));
  const LinkState wanted_end = flat(link, (link.jerk_rad_s3 - jerk_rad_s3_) / h);
  jerk_rad_s3_ = link.jerk_rad_s3;
  // A torque that is held over the period must change the momentum as much as the planned motion does.
  const double momentum_Nms =
      joint.motor_inertia_kgm2 * (wanted_end.motor_velocity_rad_s - wanted_.motor_velocity_rad_s) +
      joint.link_inertia_kgm2 * (wanted_end.link_velocity_rad_s - wanted_.link_velocity_rad_s);
  const double gravity_Nm =
      0.5 * (joint.gravity.at(wanted_.link_position_rad) + joint.gravity.at(wanted_end.link_position_rad));
  const bool ended = wanted_end.motor_velocity_rad_s == 0.0 && wanted_.motor_velocity_rad_s == 0.0 &&
                     wanted_end.motor_position_rad == wanted_.motor_position_rad;
  follow(momentum_Nms / h + gravity_Nm, wanted_end, possible, taken_Nm);
  const double wanted_rad_s2 = (wanted_end.link_velocity_rad_s - wanted_.link_velocity_rad_s) / h;
  wanted_ = wanted_end;
  // A regulator at its torque limit can excite the spring in a limit cycle. The model yields where the regulator needs more torque than the
  // motion, or where the motion has ended and needs none.
  if (config_.gives_way && exhausted_ && (ended || regulates_))
    next_ = moved(next_, moved(wanted_, next_, -1.0), kYield);
  if (ended) settle();
  MotorPlan plan = this->plan();
  plan.wanted_acceleration_rad_s2 = wanted_rad_s2;
  return plan;
}

}  // namespace strainwave
