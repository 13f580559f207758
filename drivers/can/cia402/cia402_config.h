// SPDX-License-Identifier: BSD-3-Clause
// Configuration of a CiA 402 drive, and the results of its set-up. Plain data.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "control/joint/drive_mode.h"
#include "drivers/can/canopen/canopen_pdo.h"
#include "drivers/can/cia402/cia402_units.h"
#include "drivers/can/cia402/touch_probe.h"

namespace strainwave::cia402 {

/// Mode of operation (6060h).
enum class OperationMode : std::int8_t {
  kTorque = 4,                ///< TQ, torque profile
  kInterpolatedPosition = 7,  ///< IP
  kCyclicPosition = 8,        ///< CSP
  kCyclicVelocity = 9,        ///< CSV
  kCyclicTorque = 10,         ///< CST
};

/// 6007h: reaction of the drive when our heartbeat is missing.
enum class AbortConnection : std::int16_t { kFault = 1, kDisableVoltage = 2, kQuickStop = 3 };

/// Number types of a temperature in the drive's object dictionary.
enum class NumberType : std::uint8_t { kInt8, kUint8, kInt16, kUint16, kInt32, kUint32, kReal32 };
constexpr std::uint8_t bytes_of(NumberType type) noexcept {
  switch (type) {
    case NumberType::kInt8:
    case NumberType::kUint8:
      return 1;
    case NumberType::kInt16:
    case NumberType::kUint16:
      return 2;
    case NumberType::kInt32:
    case NumberType::kUint32:
    case NumberType::kReal32:
      return 4;
  }
  return 4;
}

/// A temperature in the drive's object dictionary: degC = raw * scale + offset_C.
struct TemperatureObject {
  enum class Way : std::uint8_t { kPdo, kSdo };
  canopen::Entry entry;
  NumberType type = NumberType::kInt16;
  double scale_C = 1.0;  ///< degC per unit
  double offset_C = 0.0;
  Way way = Way::kSdo;
  double period_s = 1.0;  ///< interval at which it is read or sent
};

/// Converts the little-endian number `raw` to degC.
double temperature_C(const TemperatureObject& object, std::uint64_t raw) noexcept;

/// Identity that start-up requires; empty fields are not compared.
struct Identity {
  std::optional<std::uint32_t> vendor_id;
  std::optional<std::uint32_t> product_code;
  std::optional<std::uint32_t> revision_number;
  std::optional<std::uint32_t> serial_number;
};

/// Wired inputs of 60FDh. The profile assigns bits 0 to 2: negative limit, positive limit, home.
struct DriveInputs {
  bool negative_limit = false;
  bool positive_limit = false;
  bool home = false;
  ProbeSource index = ProbeSource::kNone;  ///< trigger of touch probe 1
  /// Whether an input of 60FDh is wired.
  bool any() const noexcept { return negative_limit || positive_limit || home; }
};

struct DriveConfig {
  std::string name;  ///< name of the joint
  DriveMode drive_mode = DriveMode::kTorque;
  std::uint8_t node_id = 1;  ///< 1..127
  std::uint8_t our_node_id = 127;
  Identity identity;
  UnitConfig units;
  bool absolute_encoder = false;     ///< the drive still knows its position after a restart
  DriveInputs inputs;                ///< inputs that are wired to the drive; 60FDh
  double torque_limit_Nm = 0.0;      ///< at the joint; written to 6072h, or 60E0h and 60E1h
  double following_error_rad = 0.0;  ///< limit of the daemon, compared with 6065h; 0: no comparison
  double rated_current_A = 0.0;      ///< for a drive without 6075h; 0: not given
  double period_s = 0.001;
  int delay_periods = 1;            ///< assumed by the control law; an older position is a fault
  bool produces_sync = false;       ///< this drive is the bus's SYNC producer
  bool daemon_sends_sync = true;    ///< this daemon is the SYNC producer
  double drive_heartbeat_s = 0.05;  ///< 1017h
  double drive_heartbeat_timeout_s = 0.15;
  double our_heartbeat_timeout_s = 0.15;  ///< 1016h
  double command_deadline_s = 0.02;       ///< 1400h:05; longest time of a joint without control
  AbortConnection abort_connection = AbortConnection::kQuickStop;
  std::optional<std::int16_t>
      quick_stop_option;              ///< 605Ah; unset: the drive's setting, or 2 if it closes its own loop
  int zero_torque_after = 2;          ///< periods without a position until zero torque
  int quick_stop_after = 4;           ///< periods without a position until a fault
  double quick_stop_timeout_s = 1.0;  ///< after this time the voltage is ordered off
  double step_timeout_s = 0.5;        ///< for each step of enabling
  double boot_timeout_s = 5.0;        ///< from the reset of communication
  double status_period_s = 0.01;      ///< of TPDO2
  bool following_bit =
      true;  ///< statusword bit 12 shows, except in TQ, whether the drive follows its setpoint
  std::optional<TemperatureObject> temperature;

  /// A drive that closes its own loop uses the unit of velocity for orders only.
  bool uses_drive_velocity() const noexcept {
    return !closes_loop(drive_mode) && units.velocity_rad_s_per_unit != 0.0;
  }
};

/// Positions of the fields in the drive's PDOs.
struct PdoLayout {
  struct Field {
    int pdo = 0;             ///< 1 to 3; 0: not mapped
    std::size_t offset = 0;  ///< in bytes
    std::size_t bytes = 0;
  };
  canopen::Pdo command;  ///< RPDO1: controlword, target, torque offset for the drive's own loop
  canopen::Pdo offsets;  ///< RPDO2: further orders; empty when not needed
  canopen::Pdo fast;     ///< TPDO1, with every SYNC
  canopen::Pdo slow;     ///< TPDO2, with every nth SYNC; empty when not needed
  canopen::Pdo probe;    ///< TPDO3, as TPDO2: status and position of the touch probe
  Field target, torque_offset, velocity_offset, probe_function;
  Field position, velocity, statusword, torque, mode, temperature, inputs, probe_status, probe_position;
};

/// Has the target of the preferred mode; optional objects come last. TPDO1: position, statusword and torque, or position and
/// velocity if the drive's velocity is used. TPDO2: the rest. TPDO3: touch probe. Throws InputError when objects do not fit.
PdoLayout pdo_layout(const DriveConfig& config);

/// Results of the set-up.
struct Found {
  OperationMode mode = OperationMode::kCyclicTorque;
  double rated_torque_Nm = 0.0;  ///< at the joint; 0: the drive closes its own loop and has no 6076h
  std::uint16_t statusword = 0;
  std::uint16_t error_code = 0;     ///< 603Fh when the drive is in fault
  std::vector<std::string> report;  ///< for the log
};

}  // namespace strainwave::cia402
