// SPDX-License-Identifier: BSD-3-Clause
// Checks of a catalogue before its fit: outliers, and friction that grows with temperature. Offline.
#pragma once

#include <vector>

#include "design/friction/friction_fit.h"

namespace strainwave {

/// The problem without the temperature of row `row`.
FitProblem without_row(const FitProblem& problem, Eigen::Index row);

/// A temperature without which the cost of the exponential law falls by more than kOutlierFactor. In the
/// catalogue of Zhao (2006) no such factor is above 3.
struct Outlier {
  Eigen::Index row = 0;
  double cost = 0.0;          ///< of the law fitted to it and the sound ones
  double cost_without = 0.0;  ///< of the law fitted to the sound ones
  Eigen::RowVector3d error;   ///< its parameters minus the law of the sound ones, motor side
};
inline constexpr double kOutlierFactor = 6.0;
/// So many outliers may mask each other: the law fits better only without all of them.
inline constexpr std::size_t kHidingOutliers = 3;

/// Finds outliers one after the other, the worst first, and also those that mask each other. Returns at most a quarter of the
/// temperatures and keeps at least four. Rows refer to `problem` as given. `low_C`, `high_C`: the range of the law's decay.
std::vector<Outlier> find_outliers(const FitProblem& problem, double low_C, double high_C);

/// Friction in the warmer half of the temperatures relative to the colder half, RMS in the metric. A strain-wave gear's is below 1.
double growth_with_temperature(const FitProblem& problem);

}  // namespace strainwave
