// Bringing a CiA 402 drive to where the loop can use it: identify, check, configure, read back, start; it
// stays disabled. Blocking; not real-time. docs/can.md shows the sequence frame by frame. Source: CiA 301 and
// CiA 402-2.
#pragma once

#include "drivers/can/canopen/sdo_client.h"
#include "drivers/can/cia402/cia402_config.h"

namespace strainwave::cia402 {

/// The whole sequence up to the start of the network, in the order of docs/can.md. Throws InputError naming
/// joint, node, object, value and what is allowed.
Found set_up_drive(canopen::SdoClient& client, const DriveConfig& config, const PdoLayout& layout);

/// Waits for fresh TPDOs of the mapped sizes, sending SYNC if that is our task. Throws InputError naming what
/// is missing.
void verify_drive(CanPort& port, const DriveConfig& config, const PdoLayout& layout);

/// Takes the torque off and ends the drive's supervision of us, so that our going is no fault.
void release_drive(canopen::SdoClient& client);

}  // namespace strainwave::cia402
