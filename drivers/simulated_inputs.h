// SPDX-License-Identifier: BSD-3-Clause
// Switches and index pulse of the simulated joint, from its position. Real-time safe.
#pragma once

#include <limits>

#include "drivers/actuator.h"

namespace strainwave {

struct SimulatedInputsConfig {
  double negative_limit_rad = -std::numeric_limits<double>::infinity();  ///< active at and below
  double positive_limit_rad = std::numeric_limits<double>::infinity();   ///< active at and above
  double home_from_rad = 0.0;                                            ///< home switch: active from here
  double home_to_rad = -1.0;       ///< to here; below home_from_rad: no home switch
  double index_rad = 0.0;          ///< position of one index pulse
  double index_spacing_rad = 0.0;  ///< distance between index pulses; 0: no index
};

class SimulatedInputs {
 public:
  explicit SimulatedInputs(const SimulatedInputsConfig& config) noexcept : config_(config) {}

  /// Returns the inputs at the true position `position_rad`; the drive reports this position as `shown_rad`.
  JointInputs at(double position_rad, double shown_rad) noexcept;

 private:
  SimulatedInputsConfig config_;
  JointInputs inputs_;
  double turn_ = 0.0;  ///< number of the last index pulse below the joint
  bool seen_ = false;
};

}  // namespace strainwave
