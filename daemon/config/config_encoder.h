// On which side of the gear's spring a drive's encoder sits. Gains are designed for the motor's side: with the spring between torque and
// encoder they are unstable, so an encoder of the link is refused of every joint that is not declared rigid. Not real-time.
#pragma once

#include <string>

#include "base/toml_section.h"
#include "control/encoder_side.h"

namespace strainwave {

/// Reads encoder_side, "motor" or "link"; required unless `truth` says what it is when it is not given. Throws InputError.
EncoderSide read_encoder_side(TomlSection& section, bool rigid, const std::string& truth = "");

/// Of an ODrive, which says how often its encoder turns in a turn of the joint: so often as the motor. Throws InputError.
void require_motor_encoder(const TomlSection& section, double encoder_turns_per_joint_turn, double gear_ratio,
                           bool rigid);

}  // namespace strainwave
