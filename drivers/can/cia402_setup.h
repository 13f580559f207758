// Bringing a CiA 402 drive to where the loop can use it: identify, check, configure, read back, start; it stays disabled.
// Blocking; not real-time. docs/can.md shows the sequence frame by frame. Source: CiA 301 and CiA 402-2.
#pragma once

#include "drivers/can/cia402_config.h"
#include "drivers/can/sdo_client.h"

namespace strainwave::cia402 {

/// What a drive says of itself; nothing is written.
struct Description {
  std::uint32_t device_type = 0;
  std::uint32_t vendor_id = 0;
  std::uint32_t product_code = 0;
  std::uint32_t revision_number = 0;
  std::uint32_t serial_number = 0;
  std::uint32_t supported_modes = 0;  ///< 6502h; 0 when it is no servo drive
  std::string device_name;            ///< 1008h, if it has one
};
Description describe(canopen::SdoClient& client);
/// Whether the device profile is CiA 402.
bool is_servo_drive(const Description& description) noexcept;
/// "vendor 000000FBh, product ...".
std::string to_text(const Description& description);
/// The modes of 6502h by name: "PP PV TQ CSP".
std::string modes_text(std::uint32_t supported_modes);

/// The whole sequence up to the start of the network, in the order of docs/can.md. Throws InputError naming joint, node,
/// object, value and what is allowed.
Found set_up_drive(canopen::SdoClient& client, const DriveConfig& config, const PdoLayout& layout);

/// Waits for fresh TPDOs of the mapped sizes, sending SYNC if that is our task. Throws InputError naming what is missing.
void verify_drive(CanPort& port, const DriveConfig& config, const PdoLayout& layout);

/// Takes the torque off and ends the drive's supervision of us, so that our going is no fault.
void release_drive(canopen::SdoClient& client);

}  // namespace strainwave::cia402
