// SPDX-License-Identifier: BSD-3-Clause
// The keys of [joint.gpio]: a bare motor behind amplifier, encoder and digital lines. Not real-time.
// docs/gpio.md explains them.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"
#include "daemon/config/config_homing.h"

namespace strainwave {

/// Reads the section and sets what depends on the driver: the drive, and the encoder and
/// motor data of the controller. `where` is the section's path in messages. What the joint can be homed by.
/// Throws InputError.
HomingInputs read_gpio_driver(TomlSection& section, const std::string& where, double period_s,
                              JointConfig& joint);

}  // namespace strainwave
