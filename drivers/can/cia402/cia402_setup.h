// SPDX-License-Identifier: BSD-3-Clause
// Prepares a CiA 402 drive for the loop: identifies, checks, configures, reads back and starts it; the drive
// stays disabled. Optional objects are used if the drive has them. Blocking; not real-time. docs/can.md shows
// the sequence frame by frame. Source: CiA 301 and CiA 402-2.
#pragma once

#include "drivers/can/canopen/sdo_client.h"
#include "drivers/can/cia402/cia402_config.h"
#include "drivers/can/cia402/cia402_description.h"

namespace strainwave::cia402 {

/// Checks that the drive is the configured one; reads only. A starting drive has boot_timeout_s to answer.
/// Throws InputError with joint, node and problem; the drive is then unchanged.
Description identify_drive(canopen::SdoClient& client, const DriveConfig& config);

/// Does all steps from identification until the drive is operational, in the order of docs/can.md. Objects that the drive cannot map but
/// need not have, or that SDO can read, are removed from `layout`. Throws InputError with joint, node, object, value and what is allowed.
Found set_up_drive(canopen::SdoClient& client, const DriveConfig& config, PdoLayout& layout,
                   const Description& description);

/// Waits for TPDOs of the mapped sizes and sends SYNC if that is our task. Throws InputError with the missing
/// TPDO.
void verify_drive(CanPort& port, const DriveConfig& config, const PdoLayout& layout);

/// Returns the delay from our SYNC to the arrival of the position sampled with it. It uses the last SYNC of
/// several at the loop's rate. `port` must receive our own SYNC. Throws InputError when the delay exceeds
/// config.delay_periods.
std::int64_t measure_position_delay_ns(CanPort& port, const DriveConfig& config, const PdoLayout& layout);

/// The drive must be pre-operational, where it expects no RPDO. Removes the torque and ends the drive's
/// supervision of our heartbeat, so that the end of the daemon is no fault.
void release_drive(canopen::SdoClient& client, const DriveConfig& config);

}  // namespace strainwave::cia402
