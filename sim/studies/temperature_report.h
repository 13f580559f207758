// SPDX-License-Identifier: BSD-3-Clause
// What the study of temperature shows: in tables and figures. Offline.
#pragma once

#include <string>
#include <vector>

#include "sim/studies/figure.h"
#include "sim/studies/temperature_study.h"
#include "sim/studies/text_table.h"

namespace strainwave {

inline constexpr double kColdest_C = kStudyTemperatures_C.front();
inline constexpr double kHundredMoves_rad = 0.1;

/// The hundred moves of one way.
struct HundredMoves {
  std::string way;
  std::vector<PathError> moves;
};

/// Every number.
TextTable temperature_rows(const std::vector<TemperatureRow>& rows);
TextTable hundred_moves_rows(const std::vector<HundredMoves>& hundred);

/// Per way and temperature how far the RMS error is below that of "none"; RMS and peak of each motion in the cold; what a wrong sensor
/// costs; the first move and the hundredth.
std::vector<TextTable> temperature_tables(const std::vector<TemperatureRow>& rows,
                                          const std::vector<HundredMoves>& hundred);

/// What the last way has learned: the same over sensors, of rows that are each the sixth of the same motions.
TextTable learned_table(const std::vector<TemperatureRow>& rows);

/// The same of run_friction_known(): geometric mean and worst of the motions, per temperature.
TextTable friction_known_table(const std::vector<TemperatureRow>& rows);

/// What the daemon's controller knows of friction at each temperature, and what it is. The last column is how far the
/// difference alone takes a joint from its path: over the gain of the position.
TextTable friction_table(const GainTable& gains, const JointPlantConfig& plant);

std::vector<Figure> temperature_figures(const std::vector<TemperatureRow>& rows,
                                        const std::vector<HundredMoves>& hundred);

/// Geometric mean over the motions of a way's RMS error over that of "none", whose sensor does not matter, at a temperature.
double rms_over_none(const std::vector<TemperatureRow>& rows, const std::string& way, double temperature_C,
                     const std::string& sensor = "right");

}  // namespace strainwave
