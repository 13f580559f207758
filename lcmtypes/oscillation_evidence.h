// SPDX-License-Identifier: BSD-3-Clause
// What a joint was seen to do before fault 26, as state_v1.drive_error tells it, and what it points to. Making the number is real-time safe,
// its text is not.
//
//   bits 24..31   inertia that motions showed over the configured one, in steps of 1/32; 0: not known
//   bits 12..23   how far the feedback's torque swung, in steps of 1/16 N.m
//   bits 0..11    how often per second it reversed
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>

namespace strainwave {

struct OscillationEvidence {
  double reversals_per_s = 0.0;
  double swing_Nm = 0.0;
  double inertia_ratio = 0.0;  ///< motions' over the configured; 0: not known
};

/// An inertia that is farther off is another one, and explains an oscillation: what the controller bears (docs/flexible-joint.md).
inline constexpr double kInertiaApart = 0.3;
inline constexpr double kEvidenceSwings_1_Nm = 16.0;
inline constexpr double kEvidenceRatios = 32.0;

/// All >= 0; what is too large is the largest.
inline std::uint32_t evidence_number(const OscillationEvidence& evidence) noexcept {
  const auto field = [](double value, double most) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, most)));
  };
  return field(evidence.inertia_ratio * kEvidenceRatios, 0xFF) << 24U |
         field(evidence.swing_Nm * kEvidenceSwings_1_Nm, 0xFFF) << 12U |
         field(evidence.reversals_per_s, 0xFFF);
}

/// "the torque reversed 86 times within a second, by up to 20 N.m; motions show 1.5 times the configured inertia: check load_inertia_kgm2".
std::string evidence_words(std::uint32_t number);

}  // namespace strainwave
