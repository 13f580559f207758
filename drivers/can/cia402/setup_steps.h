// SPDX-License-Identifier: BSD-3-Clause
// Functions that the steps of a CiA 402 drive's set-up share. Blocking; not real-time.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "drivers/can/canopen/sdo_client.h"
#include "drivers/can/cia402/cia402_config.h"

namespace strainwave::cia402 {

/// Reads a number from the drive.
inline std::uint32_t number(canopen::SdoClient& client, canopen::Entry entry, std::size_t bytes = 4) {
  return static_cast<std::uint32_t>(client.upload_number(entry, bytes));
}

/// Converts seconds to milliseconds, or amperes to milliamperes.
inline std::uint32_t thousandths(double value) {
  return static_cast<std::uint32_t>(std::lround(value * 1e3));
}

/// Throws InputError with joint and node.
[[noreturn]] inline void refuse(const canopen::SdoClient& client, const std::string& what) {
  throw InputError(client.who() + ": node " + std::to_string(client.node()) + ": " + what);
}

/// Writes 0 to an optional offset; refuses a drive that keeps another value.
void clear_offset(canopen::SdoClient& client, canopen::Entry entry, std::uint8_t bytes, const char* purpose);

/// Returns the first mode for `wanted` that 6502h lists, or, without 6502h, the first that 6061h shows after setting it.
OperationMode choose_mode(canopen::SdoClient& client, DriveMode wanted,
                          std::optional<std::uint32_t> supported);
void set_mode(canopen::SdoClient& client, OperationMode mode);
/// "CST"
const char* to_text(OperationMode mode);

/// Configures the PDOs and removes from `layout` optional objects that the drive cannot map.
void configure_pdos(canopen::SdoClient& client, const DriveConfig& config, PdoLayout& layout,
                    std::vector<std::string>& report);
/// Removes the last object of `pdo`, if it is at `field`.
void leave_out(canopen::Pdo& pdo, PdoLayout::Field& field);

/// Makes the drive supervise RPDO1 (1400h:05); false when it cannot.
bool configure_deadline(canopen::SdoClient& client, const DriveConfig& config);

/// Returns the rated torque at the joint in N.m. Compares 6075h with 6076h and writes the torque limit.
double configure_torque(canopen::SdoClient& client, const DriveConfig& config,
                        std::vector<std::string>& report);

/// For a drive that closes its own loop: configures its stop and compares its limit of the following error.
void configure_own_loop(canopen::SdoClient& client, const DriveConfig& config,
                        std::vector<std::string>& report);

/// Clears, checks or reports settings that would invert, offset or slow the ordered torque.
void configure_torque_path(canopen::SdoClient& client, const DriveConfig& config, OperationMode mode,
                           std::vector<std::string>& report);

}  // namespace strainwave::cia402
