// SPDX-License-Identifier: BSD-3-Clause
#include "control/friction/friction_learning.h"

#include <cmath>

#include "base/units.h"

namespace strainwave {

namespace {

// Rates per second. With their sum the loop is stable at the corners of the shipped boxes, with one exception (docs/certificate.md).
constexpr double kFrictionRate_1_s = 35.0;
constexpr double kLoadRate_1_s = 5.0;
// Feedback counts up to this share of the friction, so that a collision is not learned as friction within a few periods.
constexpr double kCounted = 0.5;
// Memory of the mean. 0.3 and 1 s leave about as many joints with a wrong load off their target (`strainwave-sim flexible --wrong`).
constexpr double kMean_s = 0.5;

}  // namespace

void FrictionLearning::load(const FuzzyFriction& table) noexcept {
  table_ = table;
  blend();
}

void FrictionLearning::weigh(const TemperatureWeights& weights) noexcept {
  weights_ = weights;
  blend();
}

void FrictionLearning::set(const LearnedFriction& learned) noexcept {
  for (std::size_t i = 0; i < learned.scale.size(); ++i)
    learned_.scale[i] = std::clamp(learned.scale[i], kLeastScale, kMostScale);
  set_load(learned.load_Nm);
  blend();
}

void FrictionLearning::blend() noexcept {
  TemperatureWeights scaled = weights_;
  scaled.count = std::min(weights_.count, table_.rule_count);
  double squares = 0.0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(scaled.count); ++i) {
    squares += weights_.weight[i] * weights_.weight[i];
    scaled.weight[i] *= 1.0 + learned_.scale[i];
  }
  friction_ = table_.blend(scaled);
  reciprocal_squares_ = squares > 0.0 ? 1.0 / squares : 0.0;
}

double FrictionLearning::rule_friction_Nm(std::size_t rule, double stribeck,
                                          double speed_rad_s) const noexcept {
  const FrictionParameters& f = table_.rules[rule].friction;
  return f.coulomb_Nm + stribeck * (f.static_Nm - f.coulomb_Nm) + f.viscous_Nms_rad * speed_rad_s;
}

void FrictionLearning::learn_load(double feedback_Nm, double elapsed_s) noexcept {
  if (!frozen_) learned_.load_Nm += elapsed_s * kLoadRate_1_s * feedback_Nm;
}

void FrictionLearning::learn(double feedback_Nm, double motor_velocity_rad_s, double elapsed_s) noexcept {
  if (frozen_) return;
  const double speed_rad_s = std::abs(motor_velocity_rad_s);
  const double ratio = speed_rad_s / table_.velocity.stribeck().velocity_rad_s;
  const double stribeck = std::exp(-ratio * ratio);
  const auto count = static_cast<std::size_t>(std::min(weights_.count, table_.rule_count));
  double table_Nm = 0.0;
  for (std::size_t i = 0; i < count; ++i)
    table_Nm += weights_.weight[i] * rule_friction_Nm(i, stribeck, speed_rad_s);
  if (!(table_Nm > 0.0)) return;
  const double counted_Nm = std::clamp(feedback_Nm, -kCounted * table_Nm, kCounted * table_Nm);
  learned_.load_Nm += elapsed_s * kLoadRate_1_s * counted_Nm;
  const double along_Nm =
      elapsed_s * kFrictionRate_1_s * reciprocal_squares_ * counted_Nm * sign(motor_velocity_rad_s);
  for (std::size_t i = 0; i < count; ++i)
    if (rule_friction_Nm(i, stribeck, speed_rad_s) > 0.0)
      learned_.scale[i] = std::clamp(
          learned_.scale[i] + along_Nm * weights_.weight[i] / rule_friction_Nm(i, stribeck, speed_rad_s),
          kLeastScale, kMostScale);
  blend();
  add_to_mean(elapsed_s);
}

void FrictionLearning::add_to_mean(double elapsed_s) noexcept {
  weight_ += (1.0 - weight_) * elapsed_s / kMean_s;
  const double share = elapsed_s / kMean_s / weight_;
  for (std::size_t i = 0; i < mean_.scale.size(); ++i)
    mean_.scale[i] += share * (learned_.scale[i] - mean_.scale[i]);
  mean_.load_Nm += share * (learned_.load_Nm - mean_.load_Nm);
}

void FrictionLearning::end_motion() noexcept {
  if (weight_ == 0.0 || frozen_) return;
  set(mean_);
}

}  // namespace strainwave
