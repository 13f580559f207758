// SPDX-License-Identifier: BSD-3-Clause
// The tables and figures of the temperature study. Offline.
#pragma once

#include <string>
#include <vector>

#include "sim/studies/figure.h"
#include "sim/studies/temperature_study.h"
#include "sim/studies/text_table.h"

namespace strainwave {

inline constexpr double kColdest_C = kStudyTemperatures_C.front();
inline constexpr double kHundredMoves_rad = 0.1;

/// The hundred moves with one way to compensate friction.
struct HundredMoves {
  std::string way;
  std::vector<PathError> moves;
};

/// Tables with every number.
TextTable temperature_rows(const std::vector<TemperatureRow>& rows);
TextTable hundred_moves_rows(const std::vector<HundredMoves>& hundred);

/// Per way and temperature, the reduction of the RMS error against "none". Also the RMS and peak error of
/// each motion in the cold, the cost of a wrong sensor, and the moves from the first to the hundredth.
std::vector<TextTable> temperature_tables(const std::vector<TemperatureRow>& rows,
                                          const std::vector<HundredMoves>& hundred);

/// The reduction for the last way after learning, by sensor. Each of the rows is the sixth run of the same motions.
TextTable learned_table(const std::vector<TemperatureRow>& rows);

/// The same for run_friction_known(): geometric mean and worst of the motions, per temperature.
TextTable friction_known_table(const std::vector<TemperatureRow>& rows);

/// True friction and that of the gain table, at each temperature and speed. The error columns show how far
/// the difference alone moves a joint from its path: the difference over the position gain.
TextTable friction_table(const GainTable& gains, const JointPlantConfig& plant);

std::vector<Figure> temperature_figures(const std::vector<TemperatureRow>& rows,
                                        const std::vector<HundredMoves>& hundred);

/// Geometric mean over the motions: RMS error of a way over that of "none" with the right sensor, at one temperature.
double rms_over_none(const std::vector<TemperatureRow>& rows, const std::string& way, double temperature_C,
                     const std::string& sensor = "right");

}  // namespace strainwave
