// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_drive_mode.h"

namespace strainwave {

DriveMode read_drive_mode(TomlSection& section, JointConfig& joint) {
  const DriveMode mode =
      drive_mode_from_text(section.choice_or("drive_mode", "torque", {"torque", "velocity", "position"}))
          .value();
  joint.loop.controller.drive_mode = mode;
  if (!closes_loop(mode)) return mode;
  if (joint.loop.controller.encoder_side == EncoderSide::kLink)
    section.fail("drive_mode", "only \"torque\" is allowed with encoder_side = \"link\"");
  if (joint.loop.overload_stop == OverloadStop::kHoldLoad)
    section.fail("drive_mode", "only \"torque\" is allowed with joint.limits.on_overload = \"hold_load\"");
  return mode;
}

}  // namespace strainwave
