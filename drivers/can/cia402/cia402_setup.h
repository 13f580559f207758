// SPDX-License-Identifier: BSD-3-Clause
// Bringing a CiA 402 drive to where the loop can use it: identify, check, configure, read back, start; it
// stays disabled. Objects that the profile leaves to the vendor are used where they are. Blocking; not real-time. docs/can.md shows the sequence frame by frame. Source: CiA 301 and
// CiA 402-2.
#pragma once

#include "drivers/can/canopen/sdo_client.h"
#include "drivers/can/cia402/cia402_config.h"
#include "drivers/can/cia402/cia402_description.h"

namespace strainwave::cia402 {

/// Whether it is the drive that the configuration means; reads only. A drive that is still starting has boot_timeout_s to
/// answer. Throws InputError naming joint, node and what is wrong: then nothing has been changed.
Description identify_drive(canopen::SdoClient& client, const DriveConfig& config);

/// The whole sequence from there until the drive is operational, in the order of docs/can.md. What the drive cannot map and can be
/// read by SDO leaves `layout`. Throws InputError naming joint, node, object, value and what is allowed.
Found set_up_drive(canopen::SdoClient& client, const DriveConfig& config, PdoLayout& layout,
                   const Description& description);

/// Waits for fresh TPDOs of the mapped sizes, sending SYNC if that is our task. Throws InputError naming what
/// is missing.
void verify_drive(CanPort& port, const DriveConfig& config, const PdoLayout& layout);

/// From a SYNC of ours, the last of some at the loop's rate, until the position that was sampled with it has come. `port` hears our
/// SYNC come back.
/// Throws InputError when it is more than config.delay_periods allow.
std::int64_t measure_position_delay_ns(CanPort& port, const DriveConfig& config, const PdoLayout& layout);

/// Of a drive that is pre-operational, where it misses no RPDO: takes the torque off and ends its supervision of us, so that our
/// going is no fault.
void release_drive(canopen::SdoClient& client, const DriveConfig& config);

}  // namespace strainwave::cia402
