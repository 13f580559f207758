// SPDX-License-Identifier: BSD-3-Clause
// What an ODrive axis is ordered in a period, by the mode that it is driven in. Real-time safe.
#pragma once

#include "drivers/actuator.h"
#include "drivers/can/odrive/odrive_config.h"

namespace strainwave::odrive {

ControlMode control_mode(DriveMode mode) noexcept;

/// The message whose frames order the axis in this mode, and feed its watchdog.
Command order_command(DriveMode mode) noexcept;

/// The frame for `order`, whose numbers must be finite, on the joint's side. An ODrive takes a position as it comes, for the whole
/// period; it gets that of the period's middle,
///   p = p_end - 0.5 * period_s * v
CanFrame order_frame(const DriveConfig& config, const ActuatorCommand& order) noexcept;

}  // namespace strainwave::odrive
