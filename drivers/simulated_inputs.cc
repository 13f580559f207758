// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/simulated_inputs.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

JointInputs SimulatedInputs::at(double position_rad, double shown_rad) noexcept {
  inputs_.negative_limit = position_rad <= config_.negative_limit_rad;
  inputs_.positive_limit = position_rad >= config_.positive_limit_rad;
  inputs_.home = position_rad >= config_.home_from_rad && position_rad <= config_.home_to_rad;
  if (config_.index_spacing_rad <= 0.0) return inputs_;
  const double turn = std::floor((position_rad - config_.index_rad) / config_.index_spacing_rad);
  if (seen_ && turn != turn_) {
    ++inputs_.index_count;
    const double pulse_rad = config_.index_rad + std::max(turn, turn_) * config_.index_spacing_rad;
    inputs_.index_position_rad = pulse_rad + (shown_rad - position_rad);
  }
  turn_ = turn;
  seen_ = true;
  return inputs_;
}

}  // namespace strainwave
