// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/diagnosis.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "doctor/causes.h"

namespace strainwave {

namespace {

constexpr double kPriceOfExplaining = 2.0;  // also of a free lambda
constexpr double kWorthNaming = 3.5;        // about 3.5 deviations of a single feature, with the price
constexpr double kUnusual = 2.0;            // deviations; smaller ones are not shown as evidence
constexpr int kSteps = 240;                 // steps of lambda
constexpr std::size_t kMostFindings = 3;
constexpr std::array kRatios{30.0, 50.0, 80.0, 100.0, 120.0, 160.0};  // of strain-wave gears

double rho(double z) {
  return 4.0 * std::log1p(z * z / 4.0);
}

using Predicted = std::array<double, kFeatureCount>;

class Explanation {
 public:
  Explanation(const Evidence& evidence, double temperature_C, const Cause& cause)
      : evidence_(evidence), temperature_C_(temperature_C), cause_(cause) {}

  /// Finds the lambda with the smallest misfit to `features`.
  void fit(const Features& features) {
    misfit_ = 1e300;
    for (const double lambda : sizes()) {
      const Predicted predicted = predict(lambda);
      if (const double misfit = price() + misfit_with(features, predicted); misfit < misfit_) {
        misfit_ = misfit;
        predicted_ = predicted;
      }
    }
  }
  double misfit() const noexcept { return misfit_; }
  const Cause& cause() const noexcept { return cause_; }
  bool explains(std::size_t feature) const {
    return std::find(cause_.explains.begin(), cause_.explains.end(), static_cast<Feature>(feature)) !=
           cause_.explains.end();
  }
  double predicted(std::size_t feature) const { return predicted_[feature]; }

 private:
  std::vector<double> sizes() const {
    std::vector<double> sizes;
    if (cause_.by_catalogue) {
      const double told = evidence_.gear_ratio();
      for (const double ratio : kRatios)
        if (told > 0.0 && std::abs(ratio - told) > 0.05 * told) sizes.push_back(std::log(ratio / told));
    } else if (cause_.moves.empty() && !cause_.by_temperature) {
      sizes.push_back(0.0);
    } else {
      for (int i = 0; i <= kSteps; ++i)
        sizes.push_back(cause_.least + (cause_.most - cause_.least) * i / kSteps);
    }
    return sizes;
  }

  /// Price of a free lambda. A lambda from few gear ratios has none, since it rarely fits by chance.
  double price() const {
    return cause_.by_catalogue || (cause_.moves.empty() && !cause_.by_temperature) ? 0.0 : kPriceOfExplaining;
  }

  Predicted predict(double lambda) const {
    Predicted predicted{};
    for (const auto& [feature, factor] : cause_.moves)
      predicted[static_cast<std::size_t>(feature)] = factor * lambda;
    if (cause_.by_temperature) {
      const auto told = evidence_.friction_at(temperature_C_);
      const auto there = evidence_.friction_at(temperature_C_ + lambda);
      if (told && there) {
        predicted[static_cast<std::size_t>(Feature::kCoulomb)] =
            std::log(there->coulomb_Nm / told->coulomb_Nm);
        predicted[static_cast<std::size_t>(Feature::kViscous)] =
            std::log(there->viscous_Nms_rad / told->viscous_Nms_rad);
      }
    }
    return predicted;
  }

  double misfit_with(const Features& features, const Predicted& predicted) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < kFeatureCount; ++i) {
      if (!features.observations[i]) continue;
      const Observation& seen = *features.observations[i];
      const double left = rho((seen.value - predicted[i]) / seen.tolerance);
      sum += explains(i) ? std::min(left, kPriceOfExplaining) : left;
    }
    return sum;
  }

  const Evidence& evidence_;
  double temperature_C_;  ///< mean of the evidence
  const Cause& cause_;
  double misfit_ = 0.0;
  Predicted predicted_{};
};

double misfit_of_none(const Features& features) {
  double sum = 0.0;
  for (const auto& seen : features.observations)
    if (seen) sum += rho(seen->normalised());
  return sum;
}

/// Moves the features that `best` explains from `features` to the evidence of a finding.
Finding take_out(const Explanation& best, double probability, Features& features) {
  Finding finding{best.cause().name, {}, best.cause().remedy, probability};
  for (std::size_t i = 0; i < kFeatureCount; ++i) {
    auto& seen = features.observations[i];
    const bool accounted = seen && (best.explains(i) || best.predicted(i) != 0.0);
    if (!accounted) continue;
    if (std::abs(seen->normalised()) > kUnusual) finding.evidence.push_back(seen->text);
    seen.reset();
  }
  return finding;
}

}  // namespace

Diagnosis diagnose(const Evidence& evidence) {
  Features features = features_of(evidence);
  Diagnosis diagnosis;
  diagnosis.not_judged = features.not_judged;
  std::vector<Explanation> explanations;
  const double temperature_C = evidence.mean_temperature_C();
  for (const Cause& cause : causes()) explanations.emplace_back(evidence, temperature_C, cause);
  while (diagnosis.findings.size() < kMostFindings) {
    const double none = misfit_of_none(features);
    for (Explanation& explanation : explanations) explanation.fit(features);
    const auto best =
        std::min_element(explanations.begin(), explanations.end(),
                         [](const Explanation& a, const Explanation& b) { return a.misfit() < b.misfit(); });
    if (none - best->misfit() < kWorthNaming) break;
    double total = std::exp(-0.5 * (none - best->misfit()));
    for (const Explanation& other : explanations) total += std::exp(-0.5 * (other.misfit() - best->misfit()));
    diagnosis.findings.push_back(take_out(*best, 1.0 / total, features));
  }
  return diagnosis;
}

}  // namespace strainwave
