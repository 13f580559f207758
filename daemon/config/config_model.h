// SPDX-License-Identifier: BSD-3-Clause
// joint.model and what belongs to it: "flexible", motor and link with the gear's spring between them, or "rigid", one inertia. And the
// link's weight, which stands in [joint.control]. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "control/joint_controller.h"
#include "daemon/config/config.h"

namespace strainwave {

/// Reads the model of a [[joint]] whose gear ratio is in `joint.plant`, and sets what the controller uses of its parts for such a joint.
/// `joint.plant` gets the gear's name and the inertia of motor and link together, kg m2. Throws InputError.
void read_model(TomlSection& section, ConfigUse use, JointConfig& joint);

/// Reads gravity_Nm and gravity_zero_rad of the [joint.control] of a joint whose model and torque limit have been read. Throws InputError.
void read_gravity(TomlSection& control, JointControllerConfig& controller);

}  // namespace strainwave
