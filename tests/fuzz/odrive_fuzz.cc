// SPDX-License-Identifier: BSD-3-Clause
// ODrive's frames: a decoder accepts only the right size and finite numbers.
#include "drivers/can/odrive/odrive.h"

#include <cmath>

#include "drivers/can/odrive/odrive_node.h"
#include "tests/fuzz/fuzz_input.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  fuzz::FuzzInput input(data, size);
  const CanFrame frame = input.frame(0x049);
  const bool full = frame.size == kMaxCanBytes;
  STRAINWAVE_FUZZ_CHECK(odrive::decode_version(frame).has_value() == full);
  STRAINWAVE_FUZZ_CHECK(odrive::decode_heartbeat(frame).has_value() == full);
  if (const auto estimates = odrive::decode_estimates(frame))
    STRAINWAVE_FUZZ_CHECK(full && std::isfinite(estimates->position_turns) &&
                          std::isfinite(estimates->velocity_turns_s));
  if (const auto temperatures = odrive::decode_temperatures(frame))
    STRAINWAVE_FUZZ_CHECK(std::isfinite(temperatures->motor_C.value_or(0.0)) &&
                          std::isfinite(temperatures->inverter_C.value_or(0.0)));
  const auto endpoint = static_cast<std::uint16_t>(input.number(2));
  (void)odrive::decode_parameter_bool(frame, endpoint);
  if (const auto value = odrive::decode_parameter_float(frame, endpoint))
    STRAINWAVE_FUZZ_CHECK(std::isfinite(*value));
  STRAINWAVE_FUZZ_CHECK(!odrive::drive_error_text(static_cast<std::uint32_t>(input.number(4))).empty());
  return 0;
}
