// SPDX-License-Identifier: BSD-3-Clause
// Heartbeats, emergencies, error frames and their texts: a decoder accepts only the sizes of the standard.
#include "drivers/can/canopen/canopen.h"

#include "drivers/can/can_detail.h"
#include "drivers/can/can_socket.h"
#include "drivers/can/cia402/cia402_state.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  fuzz::FuzzInput input(data, size);
  const CanFrame frame = input.frame(0x083);
  const auto heartbeat = canopen::decode_heartbeat(frame);
  STRAINWAVE_FUZZ_CHECK(!heartbeat || frame.size == 1);
  if (heartbeat) STRAINWAVE_FUZZ_CHECK(!canopen::to_text(*heartbeat).empty());
  const auto emergency = canopen::decode_emergency(frame);
  STRAINWAVE_FUZZ_CHECK(!emergency || frame.size == kMaxCanBytes);
  if (emergency) {
    STRAINWAVE_FUZZ_CHECK(!canopen::emergency_text(emergency->code).empty());
    STRAINWAVE_FUZZ_CHECK(!canopen::drive_error_text(canopen::drive_error_of(*emergency)).empty());
  }
  const auto word = static_cast<std::uint32_t>(input.number(4));
  STRAINWAVE_FUZZ_CHECK(!can_detail_text(word).empty());
  (void)troubles_of(word, frame.bytes);
  const auto state = cia402::power_state_of(static_cast<std::uint16_t>(word));
  STRAINWAVE_FUZZ_CHECK(!cia402::to_text(state).empty());
  return 0;
}
