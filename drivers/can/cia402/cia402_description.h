// SPDX-License-Identifier: BSD-3-Clause
// A drive's description of itself: device type, identity, modes, name. It only reads, by SDO; not real-time.
// Source: CiA 301, objects 1000h, 1008h, 1018h; CiA 402-2, object 6502h.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/can/canopen/sdo_client.h"

namespace strainwave::cia402 {

/// What a drive reports about itself.
struct Description {
  std::uint32_t device_type = 0;
  std::uint32_t vendor_id = 0;
  std::uint32_t product_code = 0;
  std::uint32_t revision_number = 0;
  std::uint32_t serial_number = 0;
  std::optional<std::uint32_t> supported_modes;  ///< 6502h, if the servo drive has it
  std::string device_name;                       ///< 1008h, if the drive has it
};
Description describe(canopen::SdoClient& client);
/// Whether the device profile is CiA 402.
bool is_servo_drive(const Description& description) noexcept;
/// "vendor 000000FBh, product ...".
std::string to_text(const Description& description);
/// The modes of 6502h by name: "PP PV TQ CSP".
std::string modes_text(std::uint32_t supported_modes);

}  // namespace strainwave::cia402
