// SPDX-License-Identifier: BSD-3-Clause
// Reads on which side of the gear's spring a drive's encoder sits. A rigid joint has no sides. Not real-time.
#pragma once

#include <optional>

#include "base/toml_section.h"
#include "control/joint/encoder_side.h"
#include "control/joint_controller.h"

namespace strainwave {

/// Reads encoder_side, "motor" or "link", of a flexible joint; read its model first. The key is required unless `truth` gives a
/// default. Throws InputError, also if a rigid joint has the key.
void read_encoder_side(TomlSection& section, JointControllerConfig& controller,
                       std::optional<EncoderSide> truth = std::nullopt);

/// Checks how often an ODrive's encoder turns in a turn of the joint. A flexible joint needs an encoder on the motor, so this
/// must be the gear ratio. Throws InputError if it is not.
void require_motor_encoder(const TomlSection& section, double encoder_turns_per_joint_turn, double gear_ratio,
                           bool flexible);

}  // namespace strainwave
