// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_encoder.h"

#include <cmath>
#include <string>
#include <vector>

#include "base/printable.h"

namespace strainwave {

void read_encoder_side(TomlSection& section, JointControllerConfig& controller,
                       std::optional<EncoderSide> truth) {
  if (!controller.link) {
    if (section.has("encoder_side"))
      section.fail("encoder_side",
                   "it is allowed only with joint.model = \"flexible\": a rigid joint has no sides");
    return;
  }
  const std::vector<std::string> sides{to_text(EncoderSide::kMotor), to_text(EncoderSide::kLink)};
  const std::string word = truth ? section.choice_or("encoder_side", to_text(*truth), sides)
                                 : section.choice("encoder_side", sides);
  controller.encoder_side = encoder_side_from_text(word).value();
}

void require_motor_encoder(const TomlSection& section, double encoder_turns_per_joint_turn, double gear_ratio,
                           bool flexible) {
  if (!flexible || std::abs(encoder_turns_per_joint_turn - gear_ratio) <= 1e-6 * gear_ratio) return;
  section.fail("encoder_turns_per_joint_turn",
               "only joint.gear_ratio = " + number_text(gear_ratio) +
                   " (an encoder on the motor) is allowed with joint.model = \"flexible\": the gains are "
                   "unstable with the gear's spring between motor and encoder");
}

}  // namespace strainwave
