// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/peers/notch_filter.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace strainwave {

NotchFilter::NotchFilter(double frequency_rad_s, double width_share, double period_s) noexcept
    : cosine_(2.0 * std::cos(frequency_rad_s * period_s)),
      width_(0.5 * width_share * std::sin(frequency_rad_s * period_s)) {
  assert(frequency_rad_s > 0.0 && frequency_rad_s * period_s < std::numbers::pi && width_share > 0.0);
}

double NotchFilter::step(double input) noexcept {
  const double newer = input - cosine_ * (inputs_[0] - outputs_[0]);
  const double output = (newer + inputs_[1] - (1.0 - width_) * outputs_[1]) / (1.0 + width_);
  inputs_ = {input, inputs_[0]};
  outputs_ = {output, outputs_[0]};
  return output;
}

void NotchFilter::reset() noexcept {
  inputs_ = {};
  outputs_ = {};
}

}  // namespace strainwave
