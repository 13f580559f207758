// SPDX-License-Identifier: BSD-3-Clause
// Switches and index pulse of the simulated joint, by where it stands. Real-time safe.
#pragma once

#include <limits>

#include "drivers/actuator.h"

namespace strainwave {

struct SimulatedInputsConfig {
  double negative_limit_rad = -std::numeric_limits<double>::infinity();  ///< active at and below
  double positive_limit_rad = std::numeric_limits<double>::infinity();   ///< active at and above
  double home_from_rad = 0.0;                                            ///< home switch: active from here
  double home_to_rad = -1.0;       ///< to here; below home_from_rad: there is none
  double index_rad = 0.0;          ///< where one index pulse is
  double index_spacing_rad = 0.0;  ///< and the others; 0: there are none
};

class SimulatedInputs {
 public:
  explicit SimulatedInputs(const SimulatedInputsConfig& config) noexcept : config_(config) {}

  /// The joint stands at `position_rad`; the drive shows it as `shown_rad`.
  JointInputs at(double position_rad, double shown_rad) noexcept;

 private:
  SimulatedInputsConfig config_;
  JointInputs inputs_;
  double turn_ = 0.0;  ///< pulses below the joint
  bool seen_ = false;
};

}  // namespace strainwave
