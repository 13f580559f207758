// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/odrive/odrive_order.h"

namespace strainwave::odrive {

ControlMode control_mode(DriveMode mode) noexcept {
  switch (mode) {
    case DriveMode::kPosition:
      return ControlMode::kPosition;
    case DriveMode::kVelocity:
      return ControlMode::kVelocity;
    case DriveMode::kTorque:
      break;
  }
  return ControlMode::kTorque;
}

Command order_command(DriveMode mode) noexcept {
  switch (mode) {
    case DriveMode::kPosition:
      return Command::kSetPosition;
    case DriveMode::kVelocity:
      return Command::kSetVelocity;
    case DriveMode::kTorque:
      break;
  }
  return Command::kSetTorque;
}

CanFrame order_frame(const DriveConfig& config, const ActuatorCommand& order) noexcept {
  const UnitConfig& units = config.units;
  const double torque_Nm = drive_torque_Nm(units, config.torque_limit_Nm, order.torque_Nm);
  const double turns_s = drive_turns(units, order.motor_velocity_rad_s);
  switch (config.drive_mode) {
    case DriveMode::kPosition:
      return position_frame(config.node_id,
                            drive_turns(units, order.motor_position_rad - units.position_offset_rad) -
                                0.5 * config.period_s * turns_s,
                            turns_s * units.velocity_units_per_turn_s, torque_Nm * kTorqueUnitsPerNm);
    case DriveMode::kVelocity:
      return velocity_frame(config.node_id, turns_s, torque_Nm);
    case DriveMode::kTorque:
      break;
  }
  return torque_frame(config.node_id, torque_Nm);
}

}  // namespace strainwave::odrive
