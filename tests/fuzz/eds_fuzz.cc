// SPDX-License-Identifier: BSD-3-Clause
// Any electronic data sheet is read, or refused with an InputError. The simulated start-up of a drive with it always ends.
#include <string_view>

#include "base/input_error.h"
#include "drivers/can/canopen/eds_file.h"
#include "drivers/can/cia402/eds_check.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

constexpr std::uint8_t kNode = 3;

strainwave::cia402::DriveConfig some_drive() {
  strainwave::cia402::DriveConfig config;
  config.name = "elbow";
  config.node_id = kNode;
  config.units.counts_per_output_revolution = 320000;
  config.units.gear_ratio = 100.0;
  config.units.torque_constant_Nm_A = 0.192;
  config.torque_limit_Nm = 20.0;
  return config;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    const canopen::EdsFile eds = canopen::parse_eds("drive.eds", text, kNode);
    STRAINWAVE_FUZZ_CHECK(!eds.entries.empty());
    STRAINWAVE_FUZZ_CHECK(eds.node_id >= 1 && eds.node_id <= 127);
    for (const auto& [entry, found] : eds.entries) {
      STRAINWAVE_FUZZ_CHECK(eds.find(entry) == &found);
      STRAINWAVE_FUZZ_CHECK(eds.has_index(entry.index));
      STRAINWAVE_FUZZ_CHECK(found.bytes <= 8);
    }
    (void)cia402::check_data_sheet(eds, some_drive());
  } catch (const InputError&) {
    // Refused, which is right for most inputs.
  }
  return 0;
}
