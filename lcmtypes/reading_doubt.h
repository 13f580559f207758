// SPDX-License-Identifier: BSD-3-Clause
// Why a reading is implausible, as state_v1.drive_error encodes it with fault 5. The highest byte of 32 bits is the cause, the lower
// three are the size in microradians. A number never gets another meaning; docs/faults.md explains each. Making the number is
// real-time safe, making its text is not.
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
  kJump = 4,           ///< size: distance between two readings
  kStuck = 5,          ///< size: motion that the torque must have caused while the reading did not change
  kCountsMissing = 6,  ///< the drive's own finding
};

/// Larger sizes saturate at this.
inline constexpr std::int64_t kMostDoubted_urad = 0xFFFFFF;

/// `size_rad` >= 0, or infinite.
constexpr std::uint32_t doubt_number(ReadingDoubt cause, double size_rad = 0.0) noexcept {
  const double size_urad = std::min(size_rad * 1e6, static_cast<double>(kMostDoubted_urad));
  return static_cast<std::uint32_t>(cause) << 24U | static_cast<std::uint32_t>(size_urad);
}

/// Whether state_v1.drive_error is the daemon's own finding with this fault; with all others it is the drive's number.
constexpr bool has_own_finding(Fault fault) noexcept {
  return fault == Fault::kImplausibleReading || fault == Fault::kChatter;
}

/// Returns the fault in words. Fault 5 comes with its cause, fault 26 with its evidence (lcmtypes/oscillation_evidence.h). Example:
/// "implausible reading: the position jumped by 0.05 rad from one reading to the next".
std::string fault_words(Fault fault, std::int64_t drive_error);

}  // namespace strainwave
