// SPDX-License-Identifier: BSD-3-Clause
// Which loop the drive closes by itself, and what it is then ordered. Plain data. Joint side, SI; the side of the gear is the encoder's.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace strainwave {

enum class DriveMode : std::uint8_t {
  kTorque,    ///< none: the torque is the certified law's
  kVelocity,  ///< velocity; nothing of it is proved
  kPosition,  ///< position and velocity, likewise
};

/// "torque", "velocity" or "position".
constexpr const char* to_text(DriveMode mode) noexcept {
  return mode == DriveMode::kTorque ? "torque" : mode == DriveMode::kVelocity ? "velocity" : "position";
}

/// The mode of that word; nothing of another.
constexpr std::optional<DriveMode> drive_mode_from_text(std::string_view text) noexcept {
  for (const DriveMode mode : {DriveMode::kTorque, DriveMode::kVelocity, DriveMode::kPosition})
    if (text == to_text(mode)) return mode;
  return std::nullopt;
}

constexpr bool closes_loop(DriveMode mode) noexcept {
  return mode != DriveMode::kTorque;
}

/// One period of a drive that closes its own loop.
struct MotorOrder {
  double position_rad = 0.0;    ///< at the end of the period over which the order acts
  double velocity_rad_s = 0.0;  ///< in its middle, or as much earlier as the drive's own velocity is old
};

}  // namespace strainwave
