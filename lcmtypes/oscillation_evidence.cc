// SPDX-License-Identifier: BSD-3-Clause
#include "lcmtypes/oscillation_evidence.h"

#include <fmt/format.h>

namespace strainwave {

std::string evidence_words(std::uint32_t number) {
  const double ratio = (number >> 24U) / kEvidenceRatios;
  const double swing_Nm = (number >> 12U & 0xFFFU) / kEvidenceSwings_1_Nm;
  std::string words = fmt::format("the torque reversed {} times within a second, by up to {:.3g} N.m",
                                  number & 0xFFFU, swing_Nm);
  if (ratio > 0.0) words += fmt::format("; motions show {:.2g} times the configured inertia", ratio);
  if (ratio > 0.0 && std::abs(ratio - 1.0) > kInertiaApart)
    return words + ": check load_inertia_kgm2 and motor_inertia_kgm2 (inertia_kgm2)";
  return words + ": check delay_periods, the encoder's side, the gear and the load";
}

}  // namespace strainwave
