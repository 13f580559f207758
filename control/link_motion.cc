#include "control/link_motion.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace strainwave {

namespace {

// Two means of one period at least: else the acceleration steps.
constexpr int kLeastSpread = 2;

// sqrt(8) / w, w at the secant of half the torque that the hardest acceleration transmits.
double spread_periods(const LinkMotionConfig& c) noexcept {
  const double transmitted_Nm =
      c.torque_limit_Nm * c.link_inertia_kgm2 / (c.motor_inertia_kgm2 + c.link_inertia_kgm2);
  const double stiffness = c.spring.secant_Nm_rad(0.5 * transmitted_Nm);
  const double squared = stiffness * (1.0 / c.motor_inertia_kgm2 + 1.0 / c.link_inertia_kgm2);
  return std::sqrt(8.0 / squared) / c.period_s;
}

int whole_spread(const LinkMotionConfig& config) noexcept {
  return std::clamp(static_cast<int>(std::lround(spread_periods(config))), kLeastSpread, 2 * kMaxMeanPeriods);
}

}  // namespace

SmoothWindUp::SmoothWindUp(const TorsionSpring& spring) noexcept
    : far_rad_Nm_(1.0 / spring.stiffness_3_Nm_rad),
      extra_rad_Nm_(1.0 / spring.stiffness_1_Nm_rad - far_rad_Nm_),
      width_Nm_(0.0) {
  // What the softer slopes add to the angle, far out: extra * width * pi / 2.
  const double added_rad =
      extra_rad_Nm_ * spring.torque_1_Nm +
      (1.0 / spring.stiffness_2_Nm_rad - far_rad_Nm_) * (spring.torque_2_Nm - spring.torque_1_Nm);
  if (extra_rad_Nm_ > 0.0 && added_rad > 0.0)
    width_Nm_ = 2.0 * added_rad / (std::numbers::pi * extra_rad_Nm_);
  else
    extra_rad_Nm_ = 0.0;  // one slope, or one that the planned torque need not be smooth for
}

double SmoothWindUp::angle_rad(double torque_Nm) const noexcept {
  if (extra_rad_Nm_ == 0.0) return far_rad_Nm_ * torque_Nm;
  return far_rad_Nm_ * torque_Nm + extra_rad_Nm_ * width_Nm_ * std::atan(torque_Nm / width_Nm_);
}

double SmoothWindUp::compliance_rad_Nm(double torque_Nm) const noexcept {
  if (extra_rad_Nm_ == 0.0) return far_rad_Nm_;
  const double scaled = torque_Nm / width_Nm_;
  return far_rad_Nm_ + extra_rad_Nm_ / (1.0 + scaled * scaled);
}

bool LinkMotion::possible(const LinkMotionConfig& config) noexcept {
  return spread_periods(config) <= 2 * kMaxMeanPeriods;
}

LinkMotion::LinkMotion(const LinkMotionConfig& config) noexcept
    : config_(config),
      wind_up_(config.spring),
      spread_periods_(whole_spread(config)),
      first_(spread_periods_ / 2, config.period_s),
      second_(spread_periods_ - spread_periods_ / 2, config.period_s) {
  assert(config.delay_periods >= 0 && config.delay_periods <= kMaxLinkDelay);
  reset(0.0);
}

double LinkMotion::reset(double position_rad, double velocity_rad_s) noexcept {
  const double between_rad = position_rad + second_.lag_s() * velocity_rad_s;
  const double planned_rad = between_rad + first_.lag_s() * velocity_rad_s;
  first_.reset(planned_rad, velocity_rad_s);
  second_.reset(between_rad, velocity_rad_s);
  for (std::size_t i = 0; i < states_.size(); ++i) {
    // The newest, of the last period, moves on to `next_` with the first step.
    const double ago_s = static_cast<double>(i + 1) * config_.period_s;
    states_[i] = flat({position_rad - ago_s * velocity_rad_s, velocity_rad_s, 0.0, 0.0});
  }
  next_ = flat({position_rad, velocity_rad_s, 0.0, 0.0});
  rest_periods_ = velocity_rad_s == 0.0 ? config_.delay_periods + 1 : 0;
  return planned_rad;
}

LinkMotion::State LinkMotion::flat(const MotionPoint& link) const noexcept {
  const double transmitted_Nm = config_.link_inertia_kgm2 * link.acceleration_rad_s2;
  const double speed_rad_s =
      config_.link_inertia_kgm2 * link.jerk_rad_s3 * wind_up_.compliance_rad_Nm(transmitted_Nm);
  const double wind_up_rad = wind_up_.angle_rad(transmitted_Nm - config_.damping_Nms_rad * speed_rad_s);
  return {link.position_rad, link.velocity_rad_s, link.position_rad + wind_up_rad,
          link.velocity_rad_s + speed_rad_s};
}

// The planned motion's end of the period that begins now is known, and with it the joint's.
MotorPlan LinkMotion::step(const Reference& planned) noexcept {
  const double h = config_.period_s;
  const MotionPoint end{
      planned.position_rad + h * (planned.velocity_rad_s + 0.5 * h * planned.acceleration_rad_s2),
      planned.velocity_rad_s + h * planned.acceleration_rad_s2, planned.acceleration_rad_s2, 0.0};
  std::copy_backward(states_.begin(), states_.end() - 1, states_.end());
  states_.front() = next_;
  next_ = flat(second_.step(first_.step(end)));
  const State& begin = states_.front();

  MotorPlan plan;
  const auto delay = static_cast<std::size_t>(config_.delay_periods);
  plan.position_rad = states_[delay].motor_position_rad;
  plan.velocity_rad_s = (plan.position_rad - states_[delay + 1].motor_position_rad) / h;
  plan.link_position_rad = states_[delay].link_position_rad;
  plan.acting_acceleration_rad_s2 = (next_.motor_velocity_rad_s - begin.motor_velocity_rad_s) / h;
  plan.acting_velocity_rad_s = 0.5 * (next_.motor_velocity_rad_s + begin.motor_velocity_rad_s);
  plan.inertia_torque_Nm =
      config_.motor_inertia_kgm2 * plan.acting_acceleration_rad_s2 +
      config_.link_inertia_kgm2 * (next_.link_velocity_rad_s - begin.link_velocity_rad_s) / h;
  const bool rests = plan.acting_velocity_rad_s == 0.0 && plan.acting_acceleration_rad_s2 == 0.0 &&
                     next_.motor_position_rad == begin.motor_position_rad;
  rest_periods_ = rests ? std::min(rest_periods_ + 1, kMaxLinkDelay + 1) : 0;
  return plan;
}

}  // namespace strainwave
