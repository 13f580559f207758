// SPDX-License-Identifier: BSD-3-Clause
// Any configuration is read, or refused with an InputError.
#include "base/input_error.h"
#include "daemon/config/config.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  const fuzz::FuzzFile file(data, size);
  try {
    const DaemonConfig config = read_config(file.path(), ConfigUse::kCheckDrives);
    STRAINWAVE_FUZZ_CHECK(config.loop.period_s > 0.0);
    STRAINWAVE_FUZZ_CHECK(!config.prefix.empty() && !config.joints.empty());
    for (const JointConfig& joint : config.joints) {
      STRAINWAVE_FUZZ_CHECK(!joint.name.empty());
      if (const auto* drive = std::get_if<DriveOnBus>(&joint.drive))
        STRAINWAVE_FUZZ_CHECK(drive->bus < config.buses.size() &&
                              drive->slot < config.buses[drive->bus].drives.size());
    }
  } catch (const InputError&) {
    // Refused, which is right for most inputs.
  }
  return 0;
}
