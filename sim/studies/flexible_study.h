// SPDX-License-Identifier: BSD-3-Clause
// Results of controllers on joints with a spring (sim/studies/flexible_cells.h). Every cell is judged at the link and at the
// motor against the limit of sim/studies/link_limit.h. Offline; uses all cores; the result does not depend on their number.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/studies/contenders.h"
#include "sim/studies/flexible_cells.h"

namespace strainwave {

struct FlexibleResult {
  double link_ratio = 0.0;          ///< sum |e / r| of the link over the limit
  double link_counted_ratio = 0.0;  ///< the same, both sums only over |e| > kCountedError_rad
  double motor_ratio = 0.0;
  double motor_counted_ratio = 0.0;
  double settling_time_s = -1.0;  ///< from here on the link stays within two counts; -1: never
  double overshoot_rad = 0.0;     ///< of the link
  double rest_peak_Nm = 0.0;      ///< largest torque applied over the last quarter
  double rest_rms_Nm = 0.0;
  double rest_sign_changes_per_s = 0.0;
  double rest_error_rad = 0.0;  ///< largest error of the link over the last quarter
  double rest_swing_rad = 0.0;  ///< peak-to-peak motion of the link over the last quarter
  bool oscillates = false;    ///< moves by more than kOscillation_rad at rest, with a torque of changing sign
  bool switched_off = false;  ///< by the controller, which ends every oscillation
  bool diverged = false;
};

inline constexpr double kOscillation_rad = 0.5e-3;
inline constexpr double kOscillationSignChanges_Hz = 10.0;

struct FlexibleTables {
  GainTable shipped;             ///< csf-17-50.json: the daemon's table, certified for one period of delay
  GainTable shipped_for_delays;  ///< csf-17-50-delays.json: softer, certified for one and two periods
  /// Tables of the plain controllers, for several total inertias.
  std::vector<GainTable> c1, c2, c3, c4;
  /// Returns the table for the inertia nearest to `total_kgm2`.
  static const GainTable& nearest(const std::vector<GainTable>& tables, double total_kgm2);
};

/// Reads csf-17-50*.json and total-*/c1.json .. c4.json from `directory`. Throws InputError.
FlexibleTables read_flexible_tables(const std::filesystem::path& directory);

/// PID, plain C4, and the daemon's controller; with `all` also plain C1 to C3.
std::vector<Contender> flexible_contenders(const FlexibleTables& tables, bool all);

/// The daemon's controller alone, with the shipped table for every joint.
Contender daemon_contender(const FlexibleTables& tables, Mechanism without = Mechanism::kNone);

struct FlexibleRow {
  FlexibleCell cell;
  double limit_pi2 = 0.0;
  std::vector<FlexibleResult> results;  ///< one per contender
};

/// Runs every contender on every cell. `progress` gets the number of finished cells, from any thread, one call at a time.
std::vector<FlexibleRow> run_flexible(const std::vector<FlexibleCell>& cells,
                                      const std::vector<Contender>& contenders,
                                      const std::function<void(std::size_t)>& progress);

/// Runs a cell and judges it without a limit: its ratios are the sums |e / r| themselves.
FlexibleResult run_without_limit(const FlexibleCell& cell, const Contender& contender);

/// Returns whether the joint of a cell oscillates at the end, or diverges. It is fast, since it needs no limit of the link.
bool oscillates(const FlexibleCell& cell, const Contender& contender);

/// Runs a cell and returns the result with its trace.
ClosedLoopResult run_cell(const FlexibleCell& cell, const Contender& contender);

}  // namespace strainwave
