// SPDX-License-Identifier: BSD-3-Clause
// Configuration and units of an ODrive axis. Plain data; the conversions are real-time safe.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <string>

#include "control/joint/drive_mode.h"
#include "drivers/can/odrive/odrive.h"

namespace strainwave::odrive {

/// Which temperature of the drive is used for the joint.
enum class TemperatureSource : std::uint8_t { kNone, kMotor, kInverter };

/// Default of axis0.config.can.input_torque_scale: unit of the torque in a position order.
inline constexpr double kTorqueUnitsPerNm = 1000.0;

struct UnitConfig {
  double encoder_turns_per_joint_turn =
      1.0;                           ///< > 0: the gear ratio for an encoder on the motor, 1 at the joint
  int direction = 1;                 ///< -1: the drive's positive direction is the joint's negative one
  double position_offset_rad = 0.0;  ///< joint position where the drive reports 0
  double gear_ratio = 1.0;           ///< motor turns per joint turn
  bool torque_at_joint = false;  ///< the drive's N m are at the joint (its torque constant includes the gear)
  double velocity_units_per_turn_s =
      1000.0;  ///< axis0.config.can.input_vel_scale: unit of the velocity in a position order
};

/// Parameter numbers in the firmware's flat_endpoints.json; without them the watchdog is not verified.
struct WatchdogEndpoints {
  std::uint16_t enabled = 0;  ///< axis0.config.enable_watchdog
  std::uint16_t timeout = 0;  ///< axis0.config.watchdog_timeout
};

struct DriveConfig {
  std::string name;  ///< name of the joint
  std::uint8_t node_id = 0;
  DriveMode drive_mode = DriveMode::kTorque;
  UnitConfig units;
  bool absolute_encoder = false;  ///< the drive still knows its position after a restart
  double torque_limit_Nm = 0.0;   ///< at the joint, > 0
  double period_s = 0.001;
  double heartbeat_period_s = 0.1;  ///< axis0.config.can.heartbeat_msg_rate_ms, for the bus load
  double heartbeat_timeout_s = 0.35;
  int zero_torque_after = 2;   ///< periods without a position until zero torque; torque mode only
  int fault_after = 10;        ///< periods without a position until a fault
  double arm_timeout_s = 1.0;  ///< from the order until closed loop
  TemperatureSource temperature = TemperatureSource::kMotor;
  double temperature_period_s = 0.1;  ///< axis0.config.can.temperature_msg_rate_ms, for the bus load
  double max_watchdog_s = 0.2;        ///< longer watchdog time-outs of the drive are refused
  std::optional<WatchdogEndpoints> watchdog;
};

inline double joint_rad(const UnitConfig& units, double turns) noexcept {
  return units.direction * turns * 2.0 * std::numbers::pi / units.encoder_turns_per_joint_turn;
}

inline double drive_turns(const UnitConfig& units, double joint_rad) noexcept {
  return units.direction * joint_rad / (2.0 * std::numbers::pi) * units.encoder_turns_per_joint_turn;
}

inline double joint_position_rad(const UnitConfig& units, double turns) noexcept {
  return units.position_offset_rad + joint_rad(units, turns);
}

/// Returns the temperature for the joint, if the drive sends it.
inline std::optional<double> joint_temperature_C(TemperatureSource source,
                                                 const Temperatures& temperatures) noexcept {
  switch (source) {
    case TemperatureSource::kMotor:
      return temperatures.motor_C;
    case TemperatureSource::kInverter:
      return temperatures.inverter_C;
    case TemperatureSource::kNone:
      break;
  }
  return std::nullopt;
}

/// Converts joint torque to drive torque and limits it to `limit_Nm` at the joint; 0 if the torque is not finite.
inline double drive_torque_Nm(const UnitConfig& units, double limit_Nm, double joint_torque_Nm) noexcept {
  if (!std::isfinite(joint_torque_Nm)) return 0.0;
  const double limited_Nm = std::clamp(joint_torque_Nm, -limit_Nm, limit_Nm);
  return units.direction * limited_Nm / (units.torque_at_joint ? 1.0 : units.gear_ratio);
}

inline double joint_torque_Nm(const UnitConfig& units, double drive_Nm) noexcept {
  return units.direction * drive_Nm * (units.torque_at_joint ? 1.0 : units.gear_ratio);
}

}  // namespace strainwave::odrive
