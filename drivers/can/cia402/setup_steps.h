// SPDX-License-Identifier: BSD-3-Clause
// What the steps of a CiA 402 drive's set-up share. Blocking; not real-time.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "base/input_error.h"
#include "drivers/can/canopen/sdo_client.h"
#include "drivers/can/cia402/cia402_config.h"

namespace strainwave::cia402 {

/// A number of the drive's.
inline std::uint32_t number(canopen::SdoClient& client, canopen::Entry entry, std::size_t bytes = 4) {
  return static_cast<std::uint32_t>(client.upload_number(entry, bytes));
}

/// Milliseconds of seconds, milliamperes of amperes.
inline std::uint32_t thousandths(double value) {
  return static_cast<std::uint32_t>(std::lround(value * 1e3));
}

/// An InputError that names joint and node.
[[noreturn]] inline void refuse(const canopen::SdoClient& client, const std::string& what) {
  throw InputError(client.who() + ": node " + std::to_string(client.node()) + ": " + what);
}

/// 0 to an offset that the drive need not have; one that keeps another value is refused.
void clear_offset(canopen::SdoClient& client, canopen::Entry entry, std::uint8_t bytes, const char* purpose);

/// The first mode for `wanted` that 6502h names (nothing: the drive has none), or that 6061h then shows.
OperationMode choose_mode(canopen::SdoClient& client, DriveMode wanted,
                          std::optional<std::uint32_t> supported);
void set_mode(canopen::SdoClient& client, OperationMode mode);
/// "CST"
const char* to_text(OperationMode mode);

/// Takes out of `layout` what the drive cannot map and need not have.
void configure_pdos(canopen::SdoClient& client, const DriveConfig& config, PdoLayout& layout,
                    std::vector<std::string>& report);
/// The last object of `pdo`, if it is at `field`.
void leave_out(canopen::Pdo& pdo, PdoLayout::Field& field);

/// Has the drive miss RPDO1 (1400h:05); false when it cannot.
bool configure_deadline(canopen::SdoClient& client, const DriveConfig& config);

/// Rated torque at the joint in N.m: 6075h and 6076h compared, and the limit written to what the drive has for it.
double configure_torque(canopen::SdoClient& client, const DriveConfig& config,
                        std::vector<std::string>& report);

/// Of a drive that closes its own loop: its stop, and its own limit of the following error.
void configure_own_loop(canopen::SdoClient& client, const DriveConfig& config,
                        std::vector<std::string>& report);

/// What would turn, shift or slow the torque that is ordered.
void configure_torque_path(canopen::SdoClient& client, const DriveConfig& config, OperationMode mode,
                           std::vector<std::string>& report);

}  // namespace strainwave::cia402
