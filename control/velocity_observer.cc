#include "control/velocity_observer.h"

#include <algorithm>
#include <cmath>

#include "control/units.h"

namespace strainwave {

namespace {

// Bounds of what may be estimated: friction offset and load in
// units of static friction, inertia relative to the model's.
constexpr double kLeastFriction = -0.8;
constexpr double kMostFriction = 1.5;
constexpr double kMostLoad = 20.0;
constexpr double kLeastInertia = -0.5;
constexpr double kMostInertia = 1.5;

// What is not known before the joint has moved, standard deviations: the model's friction, an external torque
// that has not shown yet, and friction's change from one speed to another, in units of the model's friction
// scale; the inertia, relative. Origin: 0.3, 0.1 and 0.1 N.m with the shipped table
// (data/tables/rhs17-6006.json), whose scale is this.
constexpr double kShippedScale_Nm = 1.2666610163246734;
constexpr double kFrictionUncertainty = 0.3 / kShippedScale_Nm;
constexpr double kLoadUncertainty = 0.1 / kShippedScale_Nm;
constexpr double kFrictionDrift = 0.1 / kShippedScale_Nm;
constexpr double kRestDrift = 0.001 / kShippedScale_Nm;  // per period in motion, however slow
// The same two in a stream and on a path.
constexpr double kFollowedFrictionDrift = 0.01 / kShippedScale_Nm;
constexpr double kFollowedRestDrift = 0.003 / kShippedScale_Nm;
constexpr double kInertiaUncertainty = 0.1;
// Of the inertia, per rad/s of change of speed; of the accelerating torque, from period to period. Relative,
// tuned on the same joint.
constexpr double kInertiaDrift = 0.003;
constexpr double kTorqueUncertainty = 0.005;

// Share of a change of the model's friction (another
// temperature, another table) that its error may change by.
constexpr double kModelChange = 0.2;
constexpr double kLoadDrift = 0.1;  // a load's share of the drift
// Deviations of the velocity that a stop is doubted by; share
// of a period's friction that a doubtful direction may cost.
constexpr double kDoubtfulStop = 1.5;
constexpr double kDirectionShare = 0.25;
}  // namespace

void VelocityObserver::reset(double position_rad, double friction_scale_Nm, double velocity_rad_s,
                             double load_Nm) noexcept {
  state_ << position_rad, velocity_rad_s, 0.0, load_Nm, 0.0;
  covariance_.setZero();
  // The difference of two readings, each wrong by up to half a count.
  if (velocity_rad_s != 0.0)
    covariance_(kVelocity, kVelocity) = square(config_.encoder_resolution_rad / config_.period_s) / 6.0;
  covariance_(kPosition, kPosition) = square(config_.encoder_resolution_rad) / 12.0;
  covariance_(kFriction, kFriction) = square(kFrictionUncertainty * friction_scale_Nm);
  covariance_(kLoad, kLoad) = square(kLoadUncertainty * friction_scale_Nm);
  covariance_(kInertia, kInertia) = square(kInertiaUncertainty);
  reading_rad_ = position_rad;
  moved_rad_ = 0.0;
  periods_ = 0;
  static_friction_Nm_ = 0.0;
  surprised_ = false;
}

void VelocityObserver::predict(double torque_Nm, const JointModel& model, SurpriseCause cause) noexcept {
  if (static_friction_Nm_ > 0.0)
    covariance_(kFriction, kFriction) +=
        square(kModelChange * (model.friction.static_Nm - static_friction_Nm_));
  static_friction_Nm_ = model.friction.static_Nm;
  JointModel adapted = model;
  adapted.inertia_kgm2 *= inertia_ratio();
  inertia_kgm2_ = adapted.inertia_kgm2;
  surprised_ = false;

  const ModelMotion motion =
      adapted.advance(torque_Nm, {state_(kFriction), state_(kLoad)}, state_(kVelocity), config_.period_s);
  moved_rad_ += motion.displacement_rad;
  ++periods_;
  const bool followed = cause == SurpriseCause::kFollowedFriction;
  if (!motion.moved) {
    if (followed) doubt_rest(torque_Nm, adapted);
    return;
  }
  Covariance transition = Covariance::Identity();
  // Slow starts and stops say more about friction than about inertia: they are not let near it.
  const bool strong = std::abs(motion.velocity_rad_s - state_(kVelocity)) > adapted.stribeck.velocity_rad_s;
  const double by_inertia = strong ? 1.0 / inertia_ratio() : 0.0;
  transition.row(kPosition) << 1.0, motion.displacement_by_velocity, motion.displacement_by_friction,
      motion.displacement_by_load, motion.displacement_by_inertia * by_inertia;
  transition.row(kVelocity) << 0.0, motion.velocity_by_velocity, motion.velocity_by_friction,
      motion.velocity_by_load, motion.velocity_by_inertia * by_inertia;
  const double start_deviation = std::sqrt(covariance_(kVelocity, kVelocity));
  covariance_ = transition * covariance_ * transition.transpose();
  doubt_direction(motion, start_deviation, adapted);
  drift(motion.velocity_rad_s, model, followed);
  state_(kPosition) += motion.displacement_rad;
  state_(kVelocity) = motion.velocity_rad_s;
}

// A joint that is taken to stand may yet be moving: how far, its next reading then tells. What it has left of its speed its friction takes.
void VelocityObserver::doubt_rest(double torque_Nm, const JointModel& model) noexcept {
  const double deviation = std::sqrt(std::max(0.0, covariance_(kVelocity, kVelocity)));
  if (deviation == 0.0) return;
  const double held_Nm = model.friction.static_Nm + state_(kFriction) - std::abs(torque_Nm - state_(kLoad));
  const double slowed = std::max(0.0, held_Nm) * config_.period_s / model.inertia_kgm2;
  const double kept = std::max(0.0, 1.0 - slowed / deviation);
  Covariance transition = Covariance::Identity();
  transition(kPosition, kVelocity) = 0.5 * config_.period_s * (1.0 + kept);
  transition(kVelocity, kVelocity) = kept;
  covariance_ = transition * covariance_ * transition.transpose();
}

// Friction turns round with the velocity, which no derivative sees: a velocity of doubtful sign may have met
// either friction, and a joint that is taken to have stopped may not yet have.
void VelocityObserver::doubt_direction(const ModelMotion& motion, double start_deviation,
                                       const JointModel& model) noexcept {
  const double start_speed = std::abs(state_(kVelocity));
  if (start_speed == 0.0) return;
  double& variance = covariance_(kVelocity, kVelocity);
  if (motion.velocity_rad_s == 0.0) {
    const double deceleration = start_speed / motion.displacement_by_velocity;
    const double still_moving =
        kDoubtfulStop * start_deviation - (deceleration * config_.period_s - start_speed);
    if (still_moving > 0.0) variance += square(0.5 * still_moving);
  } else if (square(motion.velocity_rad_s) < square(kSurprise) * variance) {
    const double doubt = std::exp(-0.5 * square(motion.velocity_rad_s) / variance);
    variance +=
        square(kDirectionShare * doubt * model.friction.static_Nm * config_.period_s / model.inertia_kgm2);
  }
}

// What the model gets wrong differs from speed to speed (friction), and grows with the acceleration (inertia). In a stream and on a path friction's error is
// taken to be the same while the speed is, and at another speed, the Stribeck velocity away, no better known than before the joint had moved.
void VelocityObserver::drift(double end_velocity_rad_s, const JointModel& model, bool followed) noexcept {
  const double speed = std::max(std::abs(state_(kVelocity)), std::abs(end_velocity_rad_s));
  const double share = square(square(std::min(1.0, speed / model.stribeck.velocity_rad_s)));
  const double sliding = followed ? kFollowedFrictionDrift : kFrictionDrift;
  const double slow = followed ? kFollowedRestDrift : kRestDrift;
  const double drift = square(model.friction_scale_Nm) * (square(sliding * share) + square(slow));
  const double change_rad_s = std::abs(end_velocity_rad_s - state_(kVelocity));
  if (followed) {
    const double unknown =
        square(kFrictionUncertainty * model.friction_scale_Nm) - covariance_(kFriction, kFriction);
    covariance_(kFriction, kFriction) +=
        std::max(0.0, unknown) * std::min(1.0, change_rad_s / model.stribeck.velocity_rad_s);
  }
  covariance_(kFriction, kFriction) += drift;
  covariance_(kLoad, kLoad) += kLoadDrift * drift;
  covariance_(kInertia, kInertia) += square(kInertiaDrift * change_rad_s);
  covariance_(kVelocity, kVelocity) +=
      end_velocity_rad_s != 0.0 ? square(kTorqueUncertainty * change_rad_s) : 0.0;
}

// The mean of one component shifts and its variance shrinks
// to a share; the others follow by their correlation.
void VelocityObserver::condition(int component, double shift, double variance_ratio) noexcept {
  const double variance = covariance_(component, component);
  if (variance <= 0.0) return;
  const State gain = covariance_.col(component) / variance;
  state_ += gain * shift;
  bound_parameters();
  covariance_ -= (1.0 - variance_ratio) * variance * gain * gain.transpose();
}

void VelocityObserver::add_covariance(int a, int b, double value) noexcept {
  covariance_(a, b) += value;
  covariance_(b, a) += value;
}

// An estimate gone wrong must neither turn friction round nor ask for more than any joint needs.
void VelocityObserver::bound_parameters() noexcept {
  const double static_Nm = static_friction_Nm_;
  if (static_Nm > 0.0) {
    state_(kFriction) = std::clamp(state_(kFriction), kLeastFriction * static_Nm, kMostFriction * static_Nm);
    state_(kLoad) = std::clamp(state_(kLoad), -kMostLoad * static_Nm, kMostLoad * static_Nm);
  }
  state_(kInertia) = std::clamp(state_(kInertia), kLeastInertia, kMostInertia);
}

JointEstimate VelocityObserver::estimate() const noexcept {
  return {state_(kPosition),
          state_(kVelocity),
          {state_(kFriction), state_(kLoad)},
          inertia_ratio(),
          std::sqrt(covariance_(kPosition, kPosition)),
          std::sqrt(covariance_(kFriction, kFriction) + covariance_(kLoad, kLoad)),
          surprised_};
}

double VelocityObserver::inertia_ratio() const noexcept {
  return 1.0 + state_(kInertia);
}

}  // namespace strainwave
