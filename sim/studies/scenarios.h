// SPDX-License-Identifier: BSD-3-Clause
// The scenarios of Zhao (2006), chapter 6: setpoints, temperature, duration and plant. docs/theory.md has the
// values that the thesis leaves open. Offline.
#pragma once

#include <array>
#include <string_view>

#include "sim/joint/setting.h"
#include "sim/studies/closed_loop.h"

namespace strainwave {

/// Staircase: Tables 8 and 9, temperature 15 + 25 sin(t). Ramp: Tables 10 and 11, -10 degC and 5 more each second.
enum class Scenario { kStaircase, kRamp };
inline constexpr std::array kScenarios = {Scenario::kStaircase, Scenario::kRamp};

/// Lower end of each of the four ranges in rad, which is also the ramp's setpoint.
inline constexpr std::array kRangeStart_rad = {0.001, 0.01, 0.1, 1.0};
inline constexpr int kRangeCount = 4;

std::string_view name(Scenario scenario);

/// Staircase: starts at the range's lower end, rises by twice that every second, five steps of 1 s. Ramp:
/// constant setpoint at the lower end for 12 s. `range` in 0..kRangeCount-1.
ClosedLoopConfig scenario_config(Scenario scenario, int range, const JointPlantConfig& plant);

}  // namespace strainwave
