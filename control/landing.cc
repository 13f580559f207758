#include "control/landing.h"

#include <algorithm>
#include <cmath>

#include "control/units.h"

namespace strainwave {

namespace {

// Least friction that is believed, as a share of the model's:
// an estimate gone wrong must not turn friction round.
constexpr double kLeastFrictionLeft = 0.2;
// Share of static friction that may act against a joint
// which will stop within the period: it must stay stopped.
constexpr double kSafeReverse = 0.5;
// Where exact sensing takes a joint to be on its target.
constexpr double kExactTolerance_rad = 1e-8;
// A slide ends this far beyond the edge, in counts; its
// length may be in doubt by so much; periods that it takes.
constexpr double kSlideBeyond = 0.7;
constexpr double kSlideDoubt = 0.5;
constexpr double kShortestSlide = 3.0;
constexpr double kLongestSlide = 8.0;
// Deviation of the position, in counts, at which the search for it ends, and the same of friction, in units of
// the model's friction scale. Origin: 0.007 N.m with the shipped table, whose scale is 1.26666 N.m.
constexpr double kCertainty = 0.01;
constexpr double kFrictionCertainty = 0.007 / 1.2666610163246734;
// Pushes per landing that look for something; each halves a doubt, so that eight leave 1/256 of it.
constexpr int kSlideLimit = 8;
constexpr int kProbeLimit = 8;

}  // namespace

double landing_torque_Nm(const JointModel& model, const JointDisturbance& disturbance, double velocity_rad_s,
                         double distance_rad, double period_s, int samples) noexcept {
  const double direction = velocity_rad_s != 0.0 ? sign(velocity_rad_s) : sign(distance_rad);
  if (direction == 0.0) return disturbance.load_Nm;
  const auto friction = [&](double speed) {
    const double model_Nm = model.friction_Nm(speed);
    return std::max(kLeastFrictionLeft * model_Nm, model_Nm + disturbance.friction_offset_Nm);
  };
  const double speed = std::abs(velocity_rad_s);
  const double distance = direction * distance_rad;
  const double static_Nm = friction(0.0);
  const double inertia = model.inertia_kgm2;

  if (speed > 0.0 && 2.0 * distance <= speed * period_s) {
    // Ends within this period: exactly there if it can, but never so hard that it starts back.
    const double needed = distance > 0.0 ? 0.5 * speed * speed / distance : HUGE_VAL;
    const double friction_Nm = friction(0.5 * speed);
    const double safe = (friction_Nm + kSafeReverse * static_Nm) / inertia;
    const double deceleration = std::min(needed, std::max(safe, speed / period_s));
    return disturbance.load_Nm + direction * (friction_Nm - inertia * deceleration);
  }
  // End speed from which the joint stops at the target: by static
  // friction alone, or in half a period if that is harder.
  const double push_s = samples * period_s;
  const double beyond = distance - 0.5 * speed * push_s;
  const double coasting = static_Nm / inertia;
  double end_speed =
      coasting * (-0.5 * push_s + std::sqrt(std::max(0.0, 0.25 * push_s * push_s + 2.0 * beyond / coasting)));
  if (samples == 1 && end_speed > 0.5 * coasting * period_s) end_speed = beyond / (0.75 * period_s);
  const double acceleration = (std::max(0.0, end_speed) - speed) / push_s;
  return disturbance.load_Nm + direction * (friction(0.5 * (speed + end_speed)) + inertia * acceleration);
}

void Landing::begin(double target_rad) noexcept {
  target_rad_ = target_rad;
  aim_rad_ = target_rad;
  push_ = Push::kNone;
  still_samples_ = 0;
  push_samples_ = 0;
  slides_ = 0;
  probes_ = 0;
  resting_ = false;
}

// Where the next push goes and how long it takes.
void Landing::choose_push(const JointEstimate& then, double reading_rad, const JointModel& model) noexcept {
  aim_rad_ = target_rad_;
  push_samples_ = 1;
  const double count_rad = config_.encoder_resolution_rad;
  if (count_rad == 0.0 || told_late()) return;
  const double edge_rad =
      reading_rad + (std::floor((target_rad_ - reading_rad) / count_rad) + 0.5) * count_rad;
  if (then.friction_deviation_Nm > kFrictionCertainty * model.friction_scale_Nm && slides_ < kSlideLimit) {
    ++slides_;
    aim_rad_ = edge_rad + std::copysign(kSlideBeyond * count_rad, edge_rad - then.position_rad);
    // The doubt about friction makes a doubt about the slide's length, deviation t^2 / 2J.
    const double slide_s =
        std::sqrt(2.0 * kSlideDoubt * count_rad * model.inertia_kgm2 / then.friction_deviation_Nm);
    push_samples_ = static_cast<int>(std::clamp(slide_s / config_.period_s, kShortestSlide, kLongestSlide));
  } else if (then.position_deviation_rad > kCertainty * count_rad && probes_ < kProbeLimit) {
    ++probes_;
    aim_rad_ = edge_rad;
  }
}

double Landing::push_as_planned(const JointModel& model) noexcept {
  const int samples = std::max(1, push_samples_--);
  const double torque_Nm = landing_torque_Nm(model, plan_.disturbance, plan_.velocity_rad_s,
                                             aim_rad_ - plan_.position_rad, config_.period_s, samples);
  const ModelMotion motion =
      model.advance(torque_Nm, plan_.disturbance, plan_.velocity_rad_s, config_.period_s);
  plan_.position_rad += motion.displacement_rad;
  plan_.velocity_rad_s = motion.velocity_rad_s;
  push_ = motion.velocity_rad_s != 0.0 ? Push::kUnderWay : Push::kOver;
  return torque_Nm;
}

double Landing::tolerance_rad(const JointEstimate& then) const noexcept {
  const double exact_rad = std::max(kExactTolerance_rad, 0.5 * then.position_deviation_rad);
  return told_late() ? std::max(exact_rad, config_.encoder_resolution_rad) : exact_rad;
}

double Landing::step(const JointEstimate& now, const JointEstimate& then, double reading_rad,
                     const JointModel& model) noexcept {
  if (resting_) return then.disturbance.load_Nm;
  if (push_ == Push::kUnderWay) return push_as_planned(model);
  const bool still = then.velocity_rad_s == 0.0 && then.position_rad == now.position_rad;
  still_samples_ = still ? still_samples_ + 1 : 0;
  if (then.velocity_rad_s == 0.0) {
    // Until the encoder has shown where the last push ended, nothing is decided.
    if (still_samples_ <= config_.delay_periods) return then.disturbance.load_Nm;
    choose_push(then, reading_rad, model);
    resting_ = aim_rad_ == target_rad_ && std::abs(aim_rad_ - then.position_rad) <= tolerance_rad(then);
    if (resting_) return then.disturbance.load_Nm;
  } else if (push_ == Push::kOver) {
    return then.disturbance.load_Nm;
  }
  if (told_late()) {
    plan_ = then;
    return push_as_planned(model);
  }
  const int samples = std::max(1, push_samples_--);
  return landing_torque_Nm(model, then.disturbance, then.velocity_rad_s, aim_rad_ - then.position_rad,
                           config_.period_s, samples);
}

}  // namespace strainwave
