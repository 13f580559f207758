// SPDX-License-Identifier: BSD-3-Clause
// What the configured gain table says of friction at the recording's temperature. Joint side, SI. Not real-time.
#pragma once

#include <cmath>
#include <optional>

#include "doctor/evidence.h"

namespace strainwave {

/// Mean of the temperatures that the controller used; NaN: none.
inline double friction_temperature_C(const Evidence& evidence) {
  double sum = 0.0;
  double count = 0.0;
  for (const DoctorSample& sample : evidence.samples) {
    if (!std::isfinite(sample.temperature_used_C) || sample.temperature_status != 0) continue;
    sum += sample.temperature_used_C;
    ++count;
  }
  return sum / count;
}

/// At `offset_C` above it. Nothing: no table, or no temperature.
inline std::optional<FrictionParameters> told_friction(const Evidence& evidence, double offset_C = 0.0) {
  const double temperature_C = friction_temperature_C(evidence) + offset_C;
  if (!evidence.told.friction || !std::isfinite(temperature_C)) return std::nullopt;
  return evidence.told.friction->blend(evidence.told.friction->weights(temperature_C));
}

}  // namespace strainwave
