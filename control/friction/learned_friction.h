// What a joint has learned of its friction and its load while it moved. Plain data. Joint side, SI.
#pragma once

#include <array>

#include "control/memberships.h"

namespace strainwave {

/// Bounds of a scale: friction is never taken to be less than a tenth of the table's, nor more than four times it. Measured friction
/// changes fourfold between -10 and 40 degC (data/friction_parameters.csv), so a joint without a thermometer stays inside.
inline constexpr double kLeastScale = -0.9;
inline constexpr double kMostScale = 3.0;

/// Friction of temperature rule i is (1 + scale[i]) times the table's; scale[i] in [kLeastScale, kMostScale].
struct LearnedFriction {
  std::array<double, kMaxTemperatureRules> scale{};
  double load_Nm = 0.0;  ///< besides gravity; positive opposes positive motor torque
};

}  // namespace strainwave
