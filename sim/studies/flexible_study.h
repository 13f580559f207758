// SPDX-License-Identifier: BSD-3-Clause
// What controllers do on joints with a spring (sim/studies/flexible_cells.h). Every cell is judged at the link and at the motor against
// the limit of sim/studies/link_limit.h. Offline; uses all cores; the result does not depend on how many.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "sim/studies/contenders.h"
#include "sim/studies/flexible_cells.h"

namespace strainwave {

struct FlexibleResult {
  double link_ratio = 0.0;          ///< sum |e / r| of the link over the limit
  double link_counted_ratio = 0.0;  ///< both only with |e| > kCountedError_rad
  double motor_ratio = 0.0;
  double motor_counted_ratio = 0.0;
  double settling_time_s = -1.0;  ///< the link within two counts from here to the end; -1: never
  double overshoot_rad = 0.0;     ///< of the link
  double rest_peak_Nm = 0.0;      ///< torque applied over the last quarter
  double rest_rms_Nm = 0.0;
  double rest_sign_changes_per_s = 0.0;
  double rest_error_rad = 0.0;  ///< of the link, the largest over the last quarter
  double rest_swing_rad = 0.0;  ///< of the link, from peak to peak over the last quarter
  bool oscillates =
      false;  ///< swings at rest by more than kOscillation_rad under a torque that keeps changing sign
  bool switched_off = false;  ///< by the controller, which ends every oscillation
  bool diverged = false;
};

inline constexpr double kOscillation_rad = 0.5e-3;
inline constexpr double kOscillationSignChanges_Hz = 10.0;

struct FlexibleTables {
  GainTable shipped;             ///< csf-17-50.json: what the daemon runs, certified for one period of delay
  GainTable shipped_for_delays;  ///< csf-17-50-delays.json: softer, certified for one and two
  /// Of the plain controllers, for several total inertias.
  std::vector<GainTable> c1, c2, c3, c4;
  /// The one for the inertia nearest to `total_kgm2`.
  static const GainTable& nearest(const std::vector<GainTable>& tables, double total_kgm2);
};

/// Reads csf-17-50*.json and total-*/c1.json .. c4.json of `directory`. Throws InputError.
FlexibleTables read_flexible_tables(const std::filesystem::path& directory);

/// PID, plain C4, and the daemon's controller; with `all` also plain C1 to C3.
std::vector<Contender> flexible_contenders(const FlexibleTables& tables, bool all);

/// The daemon's controller alone, with the shipped table whatever the joint.
Contender daemon_contender(const FlexibleTables& tables, Mechanism without = Mechanism::kNone);

struct FlexibleRow {
  FlexibleCell cell;
  double limit_pi2 = 0.0;
  std::vector<FlexibleResult> results;  ///< one per contender
};

/// Runs every contender on every cell; `progress` gets how many are done, from any thread, one call at a time.
std::vector<FlexibleRow> run_flexible(const std::vector<FlexibleCell>& cells,
                                      const std::vector<Contender>& contenders,
                                      const std::function<void(std::size_t)>& progress);

/// One run of a cell, judged without a limit: its ratios are the sums |e / r| themselves.
FlexibleResult run_without_limit(const FlexibleCell& cell, const Contender& contender);

/// Whether the joint of a cell oscillates at the end, or diverged; needs no limit of the link, and so little time.
bool oscillates(const FlexibleCell& cell, const Contender& contender);

/// One run of a cell, with its trace.
ClosedLoopResult run_cell(const FlexibleCell& cell, const Contender& contender);

}  // namespace strainwave
