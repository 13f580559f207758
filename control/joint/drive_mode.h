// SPDX-License-Identifier: BSD-3-Clause
// Which loop the drive closes by itself, and what it is then ordered. Plain data. Joint side, SI; the side of the gear is the encoder's.
#pragma once

#include <cstdint>

namespace strainwave {

enum class DriveMode : std::uint8_t {
  kTorque,    ///< none: the torque is the certified law's
  kVelocity,  ///< velocity; nothing of it is proved
  kPosition,  ///< position and velocity, likewise
};

constexpr bool closes_loop(DriveMode mode) noexcept {
  return mode != DriveMode::kTorque;
}

/// One period of a drive that closes its own loop.
struct MotorOrder {
  double position_rad = 0.0;    ///< at the end of the period over which the order acts
  double velocity_rad_s = 0.0;  ///< in its middle
};

}  // namespace strainwave
