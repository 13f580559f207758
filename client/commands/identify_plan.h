// SPDX-License-Identifier: BSD-3-Clause
// Which steady speeds an identification runs through, and where. Pure. Not real-time.
#pragma once

#include <optional>
#include <strainwave/limits_v1.hpp>
#include <string>
#include <utility>
#include <vector>

#include "client/commands/commands.h"

namespace strainwave {

/// There and back at one speed, between the same two positions: what depends on the position cancels.
struct Sweep {
  double speed_rad_s = 0.0;
  double from_rad = 0.0;
  double to_rad = 0.0;
  double steady_s = 0.0;  ///< expected time at this speed, each way
};

struct IdentifyPlan {
  std::vector<Sweep> sweeps;           ///< slow ones first: the fast ones warm the joint
  std::vector<double> left_out_rad_s;  ///< speeds that the range is too short for
  std::pair<double, double> range_rad;
  double approach_speed_rad_s = 0.0;  ///< on the way to a sweep
  double max_torque_Nm = 0.0;
  double duration_s = 0.0;  ///< expected
};

/// Less time than this at a speed says little.
inline constexpr double kLeastSteady_s = 0.2;
/// Fewer speeds do not show the shape of the friction.
inline constexpr std::size_t kLeastSweeps = 3;

/// The plan from where the joint is now. Throws ClientError (usage) that names the option and the limit when
/// something would be beyond the joint's limits, or fewer than kLeastSweeps speeds fit.
IdentifyPlan plan_identification(const IdentifyArguments& arguments, const limits_v1& limits,
                                 double position_rad);

/// One line for each sweep, one for the whole.
std::string to_text(const IdentifyPlan& plan);
/// The same as one JSON object.
std::string to_json(const IdentifyPlan& plan, const std::string& joint);

}  // namespace strainwave
