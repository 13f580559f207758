// SPDX-License-Identifier: BSD-3-Clause
// The loop that a drive closes by itself, and its orders. Plain data. Joint side, SI; positions are on the side of the encoder.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace strainwave {

enum class DriveMode : std::uint8_t {
  kTorque,    ///< no loop: the certified law gives the torque
  kVelocity,  ///< a velocity loop; no certificate covers it
  kPosition,  ///< a position and a velocity loop; no certificate covers them
};

/// "torque", "velocity" or "position".
constexpr const char* to_text(DriveMode mode) noexcept {
  return mode == DriveMode::kTorque ? "torque" : mode == DriveMode::kVelocity ? "velocity" : "position";
}

/// The mode with this name, or nothing.
constexpr std::optional<DriveMode> drive_mode_from_text(std::string_view text) noexcept {
  for (const DriveMode mode : {DriveMode::kTorque, DriveMode::kVelocity, DriveMode::kPosition})
    if (text == to_text(mode)) return mode;
  return std::nullopt;
}

constexpr bool closes_loop(DriveMode mode) noexcept {
  return mode != DriveMode::kTorque;
}

/// Order for one period to a drive that closes its own loop.
struct MotorOrder {
  double position_rad = 0.0;    ///< at the end of the period over which the order acts
  double velocity_rad_s = 0.0;  ///< in its middle, or earlier by the age of the drive's own velocity
};

}  // namespace strainwave
