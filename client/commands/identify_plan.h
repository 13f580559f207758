// SPDX-License-Identifier: BSD-3-Clause
// Plans the steady speeds of an identification and their positions. Pure. Not real-time.
#pragma once

#include <optional>
#include <strainwave/limits_v1.hpp>
#include <string>
#include <utility>
#include <vector>

#include "client/commands/commands.h"

namespace strainwave {

/// A stroke there and back at one speed between the same two positions, so that effects of position cancel.
struct Sweep {
  double speed_rad_s = 0.0;
  double from_rad = 0.0;
  double to_rad = 0.0;
  double steady_s = 0.0;  ///< expected time at this speed, each way
};

struct IdentifyPlan {
  std::vector<Sweep> sweeps;           ///< slow ones first, because the fast ones warm the joint
  std::vector<double> left_out_rad_s;  ///< speeds for which the range is too short
  std::pair<double, double> range_rad;
  double approach_speed_rad_s = 0.0;  ///< speed on the way to a sweep
  double max_torque_Nm = 0.0;
  double duration_s = 0.0;  ///< expected
};

/// Shortest useful time at one speed.
inline constexpr double kLeastSteady_s = 0.2;
/// Fewer speeds do not show the shape of the friction.
inline constexpr std::size_t kLeastSweeps = 3;

/// Plans from the present position of the joint. Throws ClientError (usage) that names the option and the
/// limit. This happens beyond a limit of the joint, or when fewer than kLeastSweeps speeds fit.
IdentifyPlan plan_identification(const IdentifyArguments& arguments, const limits_v1& limits,
                                 double position_rad);

/// One line for each sweep, and one for the whole plan.
std::string to_text(const IdentifyPlan& plan);
/// The same as one JSON object.
std::string to_json(const IdentifyPlan& plan, const std::string& joint);

}  // namespace strainwave
