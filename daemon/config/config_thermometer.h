// [joint.thermometer] of the configuration: a temperature sensor that Linux shows as a file. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "drivers/temperature_file.h"

namespace strainwave {

/// Reads the section. Throws InputError.
TemperatureFileConfig read_thermometer(TomlSection section);

}  // namespace strainwave
