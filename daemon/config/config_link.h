// joint.control.gear and what belongs to it: the spring between motor and link that the controller is told of, and the link's weight.
// Not real-time.
#pragma once

#include "base/toml_section.h"
#include "control/gain_table.h"
#include "control/joint_controller.h"

namespace strainwave {

/// Reads the gear and the weight, if there are any, of a joint whose other control keys have been read. Throws InputError.
void read_link(TomlSection& section, PlantIdentity& plant, JointControllerConfig& controller);

}  // namespace strainwave
