// SPDX-License-Identifier: BSD-3-Clause
// Evidence of the oscillation before fault 26, as state_v1.drive_error encodes it, and its likely causes. Making the number is
// real-time safe, making its text is not.
//
//   bits 24..31   inertia estimated from motions, as a multiple of the configured one, in steps of 1/32; 0: not known
//   bits 12..23   amplitude of the feedback torque, in steps of 1/16 N.m
//   bits 0..11    reversals of the feedback torque per second
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace strainwave {

struct OscillationEvidence {
  double reversals_per_s = 0.0;
  double swing_Nm = 0.0;
  double inertia_ratio = 0.0;  ///< inertia estimated from motions over the configured one; 0: not known
};

/// Relative error of the inertia that the controller tolerates (docs/flexible-joint.md). A larger error explains an oscillation.
inline constexpr double kInertiaApart = 0.3;
inline constexpr double kEvidenceSwings_1_Nm = 16.0;
inline constexpr double kEvidenceRatios = 32.0;

/// Encodes `evidence`, all >= 0. Values that are too large saturate.
inline std::uint32_t evidence_number(const OscillationEvidence& evidence) noexcept {
  const auto field = [](double value, double most) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, most)));
  };
  return field(evidence.inertia_ratio * kEvidenceRatios, 0xFF) << 24U |
         field(evidence.swing_Nm * kEvidenceSwings_1_Nm, 0xFFF) << 12U |
         field(evidence.reversals_per_s, 0xFFF);
}

/// "the torque reversed 86 times within a second, by up to 20 N.m; motions show 1.5 times the configured inertia: check ..."
std::string evidence_words(std::uint32_t number);

}  // namespace strainwave
