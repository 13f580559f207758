// SPDX-License-Identifier: BSD-3-Clause
// Why a position reading cannot be true, as state_v1.drive_error tells it with fault 5: the cause in the highest byte of 32 bits, below it
// how far, in microradians. Numbers are never given another meaning; docs/faults.md explains each. Making the number is real-time safe,
// its text is not.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "strainwave/vocabulary.h"

namespace strainwave {

enum class ReadingDoubt : std::uint8_t {
  kNone = 0,
  kPositionNotFinite = 1,
  kVelocityNotFinite = 2,
  kTorqueNotFinite = 3,
  kJump = 4,   ///< how far: between two readings
  kStuck = 5,  ///< how far: the torque must have moved the joint by that, and the reading did not change
  kCountsMissing = 6,  ///< the drive's own finding
};

/// More is reported as this.
inline constexpr std::int64_t kMostDoubted_urad = 0xFFFFFF;

/// `size_rad` >= 0, or infinite.
constexpr std::uint32_t doubt_number(ReadingDoubt cause, double size_rad = 0.0) noexcept {
  const double size_urad = std::min(size_rad * 1e6, static_cast<double>(kMostDoubted_urad));
  return static_cast<std::uint32_t>(cause) << 24U | static_cast<std::uint32_t>(size_urad);
}

/// With these faults state_v1.drive_error is the daemon's own finding, with all others the drive's number.
constexpr bool has_own_finding(Fault fault) noexcept {
  return fault == Fault::kImplausibleReading || fault == Fault::kChatter;
}

/// The fault in words, with the daemon's own finding, of fault 26 lcmtypes/oscillation_evidence.h, of fault 5 the cause: "implausible
/// reading: the position jumped by 0.05 rad from one reading to the next".
std::string fault_words(Fault fault, std::int64_t drive_error);

}  // namespace strainwave
