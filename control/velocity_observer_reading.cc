// What a reading tells VelocityObserver: the edges of a count, and what contradicts the model.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "control/units.h"
#include "control/velocity_observer.h"

namespace strainwave {

namespace {

constexpr double kCertain = 6.0;       // this many deviations inside, an edge says nothing
constexpr double kSurpriseLoad = 3.0;  // that one may bring, in units of static friction
// A count in a period would be the doing of a load of several N.m, and of friction that is a fraction of itself off: in a planned motion
// this share of it is laid to a load, as if that had come some three periods before.
constexpr double kLoadShareOfACount = 0.11;
// What is left of an exact position and velocity after rounding.
constexpr double kExactVelocity_rad_s = 1e-6;

// phi(z) / Phi(z). The standard normal variable below z has mean -ratio.
double normal_ratio(double z) noexcept {
  if (z < -30.0) return -z - 1.0 / z;  // asymptote; Phi underflows
  const double density = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
  return density / (0.5 * std::erfc(-z / std::numbers::sqrt2));
}

}  // namespace

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
    // Where a new count alone tells more, as while a joint breaks away, its other edge is news as well: by one edge the joint would be far
    // beyond it. What something else pushed may be anywhere.
    const bool doubtful = covariance_(kPosition, kPosition) > square(config_.encoder_resolution_rad) / 12.0;
    if (cause == SurpriseCause::kFollowedFriction && doubtful && position_rad != reading_rad_)
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

}  // namespace strainwave
