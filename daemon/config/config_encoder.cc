#include "daemon/config/config_encoder.h"

#include <cmath>
#include <string>
#include <vector>

namespace strainwave {

namespace {

const char* const kWhy =
    "with the gear's spring before the encoder; joint.control.rigid = true says that there is no such spring";

}  // namespace

void read_encoder_side(TomlSection& section, JointControllerConfig& controller,
                       std::optional<EncoderSide> truth) {
  const std::vector<std::string> sides{to_text(EncoderSide::kMotor), to_text(EncoderSide::kLink)};
  const std::string word = truth ? section.choice_or("encoder_side", to_text(*truth), sides)
                                 : section.choice("encoder_side", sides);
  const EncoderSide side = encoder_side_from_text(word).value();
  if (side == EncoderSide::kLink && !controller.rigid && !controller.link)
    section.fail("encoder_side",
                 std::string("\"motor\" is allowed: gains for the motor's side are unstable ") + kWhy +
                     ", joint.control.gear and load_inertia_kgm2 tell of it, and take a table of gains "
                     "--encoder-side link");
  controller.encoder_side = side;
}

void require_motor_encoder(const TomlSection& section, double encoder_turns_per_joint_turn, double gear_ratio,
                           bool rigid) {
  if (rigid || std::abs(encoder_turns_per_joint_turn - gear_ratio) <= 1e-6 * gear_ratio) return;
  section.fail("encoder_turns_per_joint_turn",
               "joint.gear_ratio = " + std::to_string(gear_ratio) +
                   ", an encoder on the motor, is allowed: gains are unstable " + kWhy);
}

}  // namespace strainwave
