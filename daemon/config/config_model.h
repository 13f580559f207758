// SPDX-License-Identifier: BSD-3-Clause
// Reads joint.model and its keys: "flexible", motor and link with the gear's spring between them, or "rigid", one inertia. Also reads
// the link's weight in [joint.control]. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "control/joint_controller.h"
#include "daemon/config/config.h"

namespace strainwave {

/// Reads the model of a [[joint]] whose gear ratio is in `joint.plant`. The controller gets the two inertias and the spring of a
/// flexible joint. `joint.plant` gets the gear's name and the inertia of motor and link together, kg m2. Throws InputError.
void read_model(TomlSection& section, ConfigUse use, JointConfig& joint);

/// Reads gravity_Nm and gravity_zero_rad of [joint.control]; read the torque limit first. Throws InputError.
void read_gravity(TomlSection& control, JointControllerConfig& controller);

}  // namespace strainwave
