// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_thermometer.h"

#include "daemon/realtime/loop/periodic_clock.h"

namespace strainwave {

TemperatureFileConfig read_thermometer(TomlSection section, const std::filesystem::path& folder) {
  TemperatureFileConfig config;
  config.clock_ns = &monotonic_now_ns;
  config.file = folder / section.text("file");
  config.kind = section.choice_or("kind", "number", {"number", "one_wire"}) == "one_wire"
                    ? TemperatureFileKind::kOneWire
                    : TemperatureFileKind::kNumber;
  config.scale_C = section.number_or("scale_C", config.scale_C, {-1e3, 1e3});
  if (config.scale_C == 0.0) section.fail("scale_C", "a number other than 0 is allowed");
  config.offset_C = section.number_or("offset_C", config.offset_C, {-1e4, 1e4});
  config.period_s = section.number_or("period_s", config.period_s, {0.01, 60.0});
  section.refuse_unknown_keys();
  return config;
}

}  // namespace strainwave
