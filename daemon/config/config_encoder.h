// SPDX-License-Identifier: BSD-3-Clause
// On which side of the gear's spring a drive's encoder sits. A rigid joint has no sides. Not real-time.
#pragma once

#include <optional>

#include "base/toml_section.h"
#include "control/joint/encoder_side.h"
#include "control/joint_controller.h"

namespace strainwave {

/// Reads encoder_side, "motor" or "link", of a flexible joint whose model has been read; required unless `truth` says what it is when
/// it is not given. Throws InputError, also where a rigid joint has the key.
void read_encoder_side(TomlSection& section, JointControllerConfig& controller,
                       std::optional<EncoderSide> truth = std::nullopt);

/// Of an ODrive, which says how often its encoder turns in a turn of the joint: of a flexible joint so often as the motor, since it is
/// read as the motor's. Throws InputError.
void require_motor_encoder(const TomlSection& section, double encoder_turns_per_joint_turn, double gear_ratio,
                           bool flexible);

}  // namespace strainwave
