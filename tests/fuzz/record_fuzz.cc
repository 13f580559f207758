// SPDX-License-Identifier: BSD-3-Clause
// Any flight record is drawn and converted to MCAP, or refused with an InputError.
#include "base/input_error.h"
#include "client/text/flight_record.h"
#include "client/text/mcap_flight.h"
#include "tests/fuzz/fuzz_file.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  const fuzz::FuzzFile file(data, size);
  try {
    const FlightRecordInfo info = read_flight_record(file.path());
    STRAINWAVE_FUZZ_CHECK(is_flight_record(file.path()));
    STRAINWAVE_FUZZ_CHECK(!plot_script(info, file.path(), "record.png", 0.5).empty());
    const fuzz::FuzzFile mcap(nullptr, 0);
    STRAINWAVE_FUZZ_CHECK(!write_flight_mcap(file.path(), mcap.path()).topic.empty());
  } catch (const InputError&) {
    // Refused, which is right for most inputs.
  }
  return 0;
}
