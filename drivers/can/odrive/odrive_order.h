// SPDX-License-Identifier: BSD-3-Clause
// The order for an ODrive axis in a period, by its drive mode. Real-time safe.
#pragma once

#include "drivers/actuator.h"
#include "drivers/can/odrive/odrive_config.h"

namespace strainwave::odrive {

ControlMode control_mode(DriveMode mode) noexcept;

/// Returns the message that carries orders in this mode and feeds the watchdog.
Command order_command(DriveMode mode) noexcept;

/// Returns the frame for `order`, whose numbers are on the joint's side and must be finite. An ODrive uses a
/// position unchanged for the whole period, so it gets the position in the middle of the period:
///   p = p_end - 0.5 * period_s * v
CanFrame order_frame(const DriveConfig& config, const ActuatorCommand& order) noexcept;

}  // namespace strainwave::odrive
