#include "control/velocity_observer.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/units.h"

namespace strainwave {

namespace {

enum : int { kPosition = 0, kVelocity = 1, kFriction = 2, kLoad = 3, kInertia = 4 };

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
constexpr double kInertiaUncertainty = 0.1;
// Of the inertia, per rad/s of change of speed; of the accelerating torque, from period to period. Relative,
// tuned on the same joint.
constexpr double kInertiaDrift = 0.003;
constexpr double kTorqueUncertainty = 0.005;

constexpr double kCertain = 6.0;   // this many deviations inside, an edge says nothing
constexpr double kSurprise = 4.0;  // this many outside, the model did not foresee the reading
// Share of a change of the model's friction (another
// temperature, another table) that its error may change by.
constexpr double kModelChange = 0.2;
constexpr double kSurpriseLoad = 3.0;  // load that one surprise may bring, in units of static friction
// A count in a period would be the doing of a load of several N.m, and of friction that is a fraction of itself off: in a planned motion
// this share of it is laid to a load, as if that had come some three periods before.
constexpr double kLoadShareOfACount = 0.11;
constexpr double kLoadDrift = 0.1;  // a load's share of the drift
// Deviations of the velocity that a stop is doubted by; share
// of a period's friction that a doubtful direction may cost.
constexpr double kDoubtfulStop = 1.5;
constexpr double kDirectionShare = 0.25;
// What is left of an exact position and velocity after rounding.
constexpr double kExactVelocity_rad_s = 1e-6;

// phi(z) / Phi(z). The standard normal variable below z has mean -ratio.
double normal_ratio(double z) noexcept {
  if (z < -30.0) return -z - 1.0 / z;  // asymptote; Phi underflows
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  return density / (0.5 * std::erfc(-z / std::numbers::sqrt2));
}

double square(double x) noexcept {
  return x * x;
}

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

void VelocityObserver::predict(double torque_Nm, const JointModel& model) noexcept {
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
  if (!motion.moved) return;
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
  drift(motion.velocity_rad_s, model);
  state_(kPosition) += motion.displacement_rad;
  state_(kVelocity) = motion.velocity_rad_s;
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

// What the model gets wrong differs from speed to speed
// (friction), and grows with the acceleration (inertia).
void VelocityObserver::drift(double end_velocity_rad_s, const JointModel& model) noexcept {
  const double speed = std::max(std::abs(state_(kVelocity)), std::abs(end_velocity_rad_s));
  const double share = square(square(std::min(1.0, speed / model.stribeck.velocity_rad_s)));
  const double drift =
      square(kFrictionDrift * model.friction_scale_Nm * share) + square(kRestDrift * model.friction_scale_Nm);
  covariance_(kFriction, kFriction) += drift;
  covariance_(kLoad, kLoad) += kLoadDrift * drift;
  covariance_(kInertia, kInertia) += square(kInertiaDrift * (end_velocity_rad_s - state_(kVelocity)));
  covariance_(kVelocity, kVelocity) +=
      end_velocity_rad_s != 0.0 ? square(kTorqueUncertainty * (end_velocity_rad_s - state_(kVelocity))) : 0.0;
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

// Something that the model does not know pushed the joint since the last reading: its velocity may be anything that explains the
// distance, and a load may have come, of a size that would have moved it so far.
void VelocityObserver::admit_surprise(double distance_rad, SurpriseCause cause) noexcept {
  const double since_s = std::max(1, periods_) * config_.period_s;
  const double velocity = distance_rad / since_s;
  const double by_friction_rad =
      cause != SurpriseCause::kLoad ? std::min(distance_rad, config_.encoder_resolution_rad) : 0.0;
  const double by_load_rad = distance_rad - (1.0 - kLoadShareOfACount) * by_friction_rad;
  const double load_Nm =
      std::min(2.0 * inertia_kgm2_ * by_load_rad / square(since_s), kSurpriseLoad * static_friction_Nm_);
  const double correlation = 0.5;
  covariance_(kPosition, kPosition) += square(distance_rad);
  covariance_(kVelocity, kVelocity) += square(velocity);
  covariance_(kLoad, kLoad) += square(load_Nm);
  add_covariance(kPosition, kVelocity, correlation * distance_rad * velocity);
  add_covariance(kPosition, kLoad, -correlation * distance_rad * load_Nm);
  add_covariance(kVelocity, kLoad, -correlation * velocity * load_Nm);
}

// How far off its edges a reading may be: by the encoder, and by what the joint moves until it is really sampled.
double VelocityObserver::reading_variance() const noexcept {
  return square(config_.edge_deviation_counts * config_.encoder_resolution_rad) +
         square(config_.sampling_deviation_s * state_(kVelocity));
}

// A reading that is off by more than its edges are apart is worth no more than its middle.
void VelocityObserver::weigh(double position_rad, SurpriseCause cause) noexcept {
  const double off_rad = position_rad - state_(kPosition);
  const double variance = reading_variance() + square(config_.encoder_resolution_rad) / 12.0;
  if (std::abs(off_rad) > kSurprise * std::sqrt(covariance_(kPosition, kPosition) + variance)) {
    surprised_ = true;
    admit_surprise(std::abs(off_rad), cause);
  }
  const double share = covariance_(kPosition, kPosition) / (covariance_(kPosition, kPosition) + variance);
  condition(kPosition, share * off_rad, 1.0 - share);
}

// Keeps the part of the distribution on one side (+1: above, -1: below) of an edge.
void VelocityObserver::truncate(double edge_rad, double side, SurpriseCause cause) noexcept {
  const double inside_rad = side * (state_(kPosition) - edge_rad);
  const double edge_variance = reading_variance();
  double deviation = std::sqrt(covariance_(kPosition, kPosition) + edge_variance);
  if (inside_rad > kCertain * deviation) return;
  if (inside_rad < -kSurprise * deviation) {
    surprised_ = true;
    admit_surprise(-inside_rad, cause);
    deviation = std::sqrt(covariance_(kPosition, kPosition) + edge_variance);
  }
  const double z = inside_rad / deviation;
  const double ratio = normal_ratio(z);
  const double share = covariance_(kPosition, kPosition) / square(deviation);
  condition(kPosition, side * share * deviation * ratio, 1.0 - share * ratio * (ratio + z));
}

void VelocityObserver::correct(double position_rad, SurpriseCause cause) noexcept {
  surprised_ = false;
  const double half_rad = 0.5 * config_.encoder_resolution_rad;
  if (half_rad == 0.0) {
    condition(kPosition, position_rad - state_(kPosition), 0.0);
    state_(kPosition) = position_rad;
    return;
  }
  // An edge is news when it bounds tighter than the last reading's edge, carried along with the motion.
  const double tighter_rad = position_rad - reading_rad_ - moved_rad_;
  if (reading_variance() > square(half_rad))
    weigh(position_rad, cause);
  else if (tighter_rad != 0.0) {
    const double nearer_rad = std::copysign(half_rad, tighter_rad);
    truncate(position_rad - nearer_rad, sign(tighter_rad), cause);
    // Where a reading alone tells more, as while a joint breaks away, its other edge is news as well: by one edge the joint would be far beyond
    // it. What something else pushed may be anywhere.
    const bool doubtful = covariance_(kPosition, kPosition) > square(config_.encoder_resolution_rad) / 12.0;
    if (doubtful && cause == SurpriseCause::kStreamedFriction)
      truncate(position_rad + nearer_rad, -sign(tighter_rad), cause);
  }
  reading_rad_ = position_rad;
  moved_rad_ = 0.0;
  periods_ = 0;
}

void VelocityObserver::correct_exactly(double position_rad, double velocity_rad_s) noexcept {
  const double variance = covariance_(kVelocity, kVelocity);
  const double weight = variance / (variance + square(kExactVelocity_rad_s));
  condition(kVelocity, weight * (velocity_rad_s - state_(kVelocity)), 1.0 - weight);
  state_(kPosition) = position_rad;
  state_(kVelocity) = velocity_rad_s;
  covariance_.topRows<2>().setZero();
  covariance_.leftCols<2>().setZero();
  reading_rad_ = position_rad;
  moved_rad_ = 0.0;
  periods_ = 0;
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
