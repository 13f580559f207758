// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/spring_plant.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "control/joint/link_velocity.h"

namespace strainwave {

namespace {

constexpr int kTerms = 30;
// The weighted norm up to which the remainder is far below the rounding of the then large sum: 4^31 / 31! = 6e-16.
constexpr double kMostNorm = 4.0;

using Weights = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kSpringPlantStates + 1, 1>;

// Positions have weight 1, velocities the fastest swing, the torque one that makes such a velocity in a period. Any weights give a proof.
Weights weights_of(const ProofMatrix& size) {
  const Eigen::Index u = size.rows() - 1;
  const double stiffness = u == kSpringPlantStates ? size(3, 2) : 0.0;
  const double swing = std::max(std::sqrt(size(0, 1) * stiffness), 1e-3);  // h w
  const double per_position = swing / std::max(size(0, 1), 1e-300);
  Weights d(u + 1);
  for (Eigen::Index i = 0; i < u; ++i) d(i) = i % 2 == 0 ? 1.0 : per_position;
  d(u) = swing * per_position / std::max(size(1, u), 1e-300);
  return d;
}

double norm(const ProofMatrix& size, const Weights& d) {
  double largest = 0.0;
  for (Eigen::Index i = 0; i < d.size(); ++i) {
    double sum = 0.0;
    for (Eigen::Index j = 0; j < d.size(); ++j) sum += size(i, j) * d(j) / d(i);
    largest = std::max(largest, sum);
  }
  return BoundedMatrix::kUp * largest;
}

// `amount` in units of the weights, entry by entry.
ProofMatrix in_units(const Weights& d, double amount) {
  const ProofMatrix units = d * d.cwiseInverse().transpose();
  return BoundedMatrix::kUp * amount * units;
}

// Upper bound of sum_{k > n} beta^k / k!.
double tail_of_series(double beta, int n) {
  if (!(beta <= kMostNorm)) return std::numeric_limits<double>::infinity();
  double term = 1.0;
  for (int k = 1; k <= n + 1; ++k) term *= beta / k;
  return 2.0 * term + std::numeric_limits<double>::min();  // the next factors are below 4 / 29
}

}  // namespace

BoundedMatrix spring_generator(const SpringPlant& plant, double period_s) {
  const Bounded h = period_s;
  const Bounded by_motor = h / plant.motor_inertia_kgm2;
  const bool rigid = plant.link_inertia_kgm2 == 0.0;
  const Eigen::Index u = rigid ? kRigidPlantStates : kSpringPlantStates;
  const Bounded K = plant.stiffness_Nm_rad;
  const Bounded D = plant.damping_Nms_rad;
  const Bounded b = plant.viscous_Nms_rad;
  BoundedMatrix M(u + 1, u + 1);
  M.set(0, 1, h);
  M.set(1, 1, -(b * by_motor));
  M.set(1, u, by_motor);
  if (rigid) return M;
  const Bounded by_both = by_motor + h / plant.link_inertia_kgm2;
  M.set(1, 2, K * by_motor);
  M.set(1, 3, D * by_motor);
  M.set(2, 3, h);
  M.set(3, 1, b * by_motor);
  M.set(3, 2, -(K * by_both));
  M.set(3, 3, -(D * by_both));
  M.set(3, 4, -by_motor);
  return M;
}

BoundedMatrix spring_exponential(const BoundedMatrix& generator) {
  const ProofMatrix size = generator.magnitude();
  const Weights d = weights_of(size);
  const Eigen::Index n = size.rows();
  BoundedMatrix sum(ProofMatrix::Identity(n, n));
  BoundedMatrix term = sum;
  for (int k = 1; k <= kTerms; ++k) {
    term = (Bounded(1.0) / k) * (term * generator);
    sum = sum + term;
  }
  sum.error = BoundedMatrix::kUp * (sum.error + in_units(d, tail_of_series(norm(size, d), kTerms)));
  return sum;
}

// Sums the terms of exp(M + t N) and of its first two derivatives by t, with every entry at its largest.
ProofMatrix interpolation_error(const ProofMatrix& size, const ProofMatrix& change) {
  const Weights d = weights_of(size);
  const Eigen::Index n = size.rows();
  ProofMatrix term = ProofMatrix::Identity(n, n);
  ProofMatrix first = ProofMatrix::Zero(n, n);
  ProofMatrix second = ProofMatrix::Zero(n, n);
  ProofMatrix sum = ProofMatrix::Zero(n, n);
  for (int k = 1; k <= kTerms; ++k) {
    second = (second * size + 2.0 * (first * change)) / k;
    first = (first * size + term * change) / k;
    term = (term * size) / k;
    sum += second;
  }
  const double changes = norm(change, d);
  const double tail = changes * changes * tail_of_series(norm(size, d), kTerms - 2);
  // Every step multiplies the rounding of the bounds; kTerms steps and the sum stay far below this factor.
  return (1.0 + kTerms * 256.0 * bounded_detail::kHalfUlp) * 0.125 * (sum + in_units(d, tail));
}

namespace {

void set_row(BoundedMatrix& H, Eigen::Index row, const BoundedMatrix& entries) {
  for (Eigen::Index j = 0; j < H.value.cols(); ++j) H.set(row, j, {entries.value(0, j), entries.error(0, j)});
}

BoundedMatrix without_integral(const BoundedMatrix& H) {
  const Eigen::Index n = H.value.rows() - 1;
  return BoundedMatrix::from(H.value.bottomRightCorner(n, n), H.error.bottomRightCorner(n, n));
}

// u from l, which is a state as well.
BoundedMatrix with_lead(const BoundedMatrix& law, double lead_periods) {
  BoundedMatrix torque = (Bounded(1.0) + lead_periods) * law;
  torque.set(0, law.value.cols() - 1, -lead_periods);
  return torque;
}

}  // namespace

BoundedMatrix spring_loop(const BoundedMatrix& sampled, const GainRow& gain, const SpringLoop& loop) {
  const int delay_periods = loop.delay_periods;
  assert(delay_periods >= 0 && delay_periods <= kMaxBoxDelay);
  const Eigen::Index plant = loop.plant_states;
  assert(sampled.value.rows() == plant + 1);
  const Eigen::Index n = loop_states(loop.plant_states, delay_periods, loop.lead_periods);
  const Eigen::Index z = 1 + plant;
  const Bounded share = velocity_share(loop.encoder_side, loop.period_s);
  const Bounded by_difference = share * gain(2) / loop.period_s;
  BoundedMatrix law(1, n);
  law.set(0, 0, gain(0));
  law.set(0, z, -by_difference);
  BoundedMatrix H(n, n);
  H.set(0, 0, 1.0);
  H.set(z, z, Bounded(1.0) - share);
  // States in y: the motor's position, and for an encoder on the link the wind-up.
  for (const Eigen::Index y : {1, 3}) {
    if (y == 3 && (loop.encoder_side == EncoderSide::kMotor || plant == kRigidPlantStates)) break;
    law.set(0, y, Bounded(gain(1)) + by_difference);
    H.set(0, y, loop.period_s);
    H.set(z, y, share);
  }
  for (Eigen::Index i = 0; i < plant; ++i)
    for (Eigen::Index j = 0; j < plant; ++j) H.set(1 + i, 1 + j, {sampled.value(i, j), sampled.error(i, j)});
  const bool leads = loop.lead_periods != 0.0;
  if (leads) set_row(H, n - 1, law);
  const BoundedMatrix torque = leads ? with_lead(law, loop.lead_periods) : law;
  BoundedMatrix input(n, n);
  for (Eigen::Index i = 0; i < plant; ++i)
    input.set(1 + i, 0, {sampled.value(i, plant), sampled.error(i, plant)});
  if (delay_periods == 0) {
    BoundedMatrix first(n, n);
    set_row(first, 0, torque);
    H = H + input * first;
  } else {
    set_row(H, z + 1, torque);
    for (int i = 1; i < delay_periods; ++i) H.set(z + 1 + i, z + i, 1.0);
    for (Eigen::Index i = 1; i <= plant; ++i)
      H.set(i, z + delay_periods, {input.value(i, 0), input.error(i, 0)});
  }
  return loop.has_integrator ? H : without_integral(H);
}

}  // namespace strainwave
