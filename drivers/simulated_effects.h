// SPDX-License-Identifier: BSD-3-Clause
// Reads the effects of the simulated joint from the daemon's configuration. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "drivers/simulated_actuator.h"
#include "sim/joint/effects_file.h"

namespace strainwave {

/// Reads the keys of sim/joint/effects_file.h for a joint with `gear_ratio`. Throws InputError.
inline void read_simulated_effects(TomlSection& section, double gear_ratio, SimulatedActuatorConfig& config) {
  config.plant.effects.gear_ratio = gear_ratio;
  read_effects(section, false, config.plant);
}

}  // namespace strainwave
