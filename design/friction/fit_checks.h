// SPDX-License-Identifier: BSD-3-Clause
// Checks of a catalogue before its fit: temperatures that spoil it, and friction that grows with temperature. Offline.
#pragma once

#include <vector>

#include "design/friction/friction_fit.h"

namespace strainwave {

/// The problem without the temperature of row `row`.
FitProblem without_row(const FitProblem& problem, Eigen::Index row);

/// A temperature without which the exponential law fits the others far better: by a factor of kOutlierFactor in the cost. The
/// catalogue of Zhao (2006) has none above 3.
struct Outlier {
  Eigen::Index row = 0;
  double cost = 0.0;          ///< of it and the sound ones
  double cost_without = 0.0;  ///< of the sound ones alone
  Eigen::RowVector3d error;   ///< its parameters less the law of the sound ones, motor side
};
inline constexpr double kOutlierFactor = 6.0;
/// As many may hide each other: without one of them the law fits no better, without all it does.
inline constexpr std::size_t kHidingOutliers = 3;

/// The worst, then the worst of what is left, and so on, those that hide each other too; at most a quarter of the temperatures, and at
/// least four are kept. Rows count in `problem` as it was given. `low_C`, `high_C`: the range of the law's decay.
std::vector<Outlier> find_outliers(const FitProblem& problem, double low_C, double high_C);

/// Friction of the warmer half of the temperatures over that of the colder, root mean square in the metric: a strain-wave gear's falls.
double growth_with_temperature(const FitProblem& problem);

}  // namespace strainwave
