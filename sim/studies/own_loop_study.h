// SPDX-License-Identifier: BSD-3-Clause
// The contribution of the plan to a drive that closes its own loop. The cascade of sim/studies/peers/ runs at the drive's rate on
// the motions of sim/studies/temperature_study.h, with more and more of the daemon's knowledge. Offline; uses all cores.
//
//   alone          the path's position each millisecond, as a program sends it
//   plan           the daemon's plan of a rigid joint: position and velocity
//   wind-up        the plan with the gear's spring: the motor's position and velocity
//   all offsets    wind-up, and the torque that plan, friction and load need
//   margin         all offsets, with the drive's loops tuned for one period of delay more than there is, as the daemon's gains are
//   torque mode    the daemon's own law, certified
#pragma once

#include <array>
#include <string>
#include <vector>

#include "sim/studies/flexible_study.h"
#include "sim/studies/temperature_study.h"

namespace strainwave {

/// The information that the drive gets.
enum class Told { kNothing, kPlan, kWindUp, kAllOffsets };

inline constexpr std::array<double, 3> kDriveRates_Hz = {1000.0, 4000.0, 8000.0};
inline constexpr std::array<double, 2> kOwnLoopTemperatures_C = {-10.0, 30.0};

/// The cascade behind a bus of 1 kHz, tuned for its delay plus `margin_periods`. The plant's period is that of the drive.
FrictionWay own_loop_way(const GainTable& table, Told told, double margin_periods = 0.0);

struct OwnLoopRow {
  std::string way;
  double rate_Hz = 0.0;  ///< rate of the drive's loop
  double temperature_C = 0.0;
  /// Geometric means over the motions: RMS error of the link from the path, and its ratio to that in torque mode.
  double rms_rad = 0.0;
  double over_torque_mode = 0.0;
};

/// Runs every way at every rate, the torque mode first. Torque mode and margin run only at 1 kHz.
std::vector<OwnLoopRow> run_own_loops(const FlexibleTables& tables);

}  // namespace strainwave
