// SPDX-License-Identifier: BSD-3-Clause
// Reads the keys of [joint.gpio]: a bare motor with amplifier, encoder and digital lines. Not real-time.
// docs/gpio.md explains them.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"
#include "daemon/config/config_homing.h"

namespace strainwave {

/// Reads the section and sets the values that depend on the driver: the drive, and the encoder and motor data of the
/// controller. `where` is the section's path in messages. Returns the inputs for homing. Throws InputError.
HomingInputs read_gpio_driver(TomlSection& section, const std::string& where, double period_s,
                              JointConfig& joint);

}  // namespace strainwave
