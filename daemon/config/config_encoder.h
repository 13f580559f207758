// On which side of the gear's spring a drive's encoder sits. Gains for the motor's side are unstable with the spring between torque and
// encoder, so an encoder of the link is refused of every joint that is neither declared rigid nor told of its spring, whose table must
// then be for the link's side. Not real-time.
#pragma once

#include <optional>

#include "base/toml_section.h"
#include "control/encoder_side.h"
#include "control/joint_controller.h"

namespace strainwave {

/// Reads encoder_side, "motor" or "link", of a joint whose control keys have been read; required unless `truth` says what it is when
/// it is not given. Throws InputError.
void read_encoder_side(TomlSection& section, JointControllerConfig& controller,
                       std::optional<EncoderSide> truth = std::nullopt);

/// Of an ODrive, which says how often its encoder turns in a turn of the joint: so often as the motor. Throws InputError.
void require_motor_encoder(const TomlSection& section, double encoder_turns_per_joint_turn, double gear_ratio,
                           bool rigid);

}  // namespace strainwave
