// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/config/config_odrive.h"

#include <algorithm>
#include <cmath>

#include "base/printable.h"
#include "base/units.h"
#include "daemon/config/config_doubts.h"
#include "daemon/config/config_drive_mode.h"
#include "daemon/config/config_encoder.h"
#include "daemon/config/config_motor.h"
#include "drivers/can/odrive/odrive_node.h"

namespace strainwave {

namespace {

constexpr Range kRates_s{0.001, 10.0};
constexpr std::int64_t kMaxEndpoint = 0xFFFF;

odrive::TemperatureSource read_temperature_source(TomlSection& section) {
  const std::string source = section.choice_or("temperature_source", "motor", {"motor", "inverter", "none"});
  if (source == "none") return odrive::TemperatureSource::kNone;
  return source == "motor" ? odrive::TemperatureSource::kMotor : odrive::TemperatureSource::kInverter;
}

odrive::WatchdogEndpoints read_watchdog(TomlSection section) {
  odrive::WatchdogEndpoints endpoints;
  endpoints.enabled = static_cast<std::uint16_t>(section.integer("enabled_endpoint", 1, kMaxEndpoint));
  endpoints.timeout = static_cast<std::uint16_t>(section.integer("timeout_endpoint", 1, kMaxEndpoint));
  section.refuse_unknown_keys();
  return endpoints;
}

void read_units(TomlSection& section, const JointConfig& joint, odrive::UnitConfig& units) {
  units.encoder_turns_per_joint_turn = section.number("encoder_turns_per_joint_turn", {1e-3, 1e6});
  require_motor_encoder(section, units.encoder_turns_per_joint_turn, joint.plant.gear_ratio,
                        joint.loop.controller.link.has_value());
  units.direction = section.choice_or("direction", "same", {"same", "reversed"}) == "same" ? 1 : -1;
  units.position_offset_rad = section.number_or("position_offset_rad", 0.0, {-1e3, 1e3});
  doubt_angle(section, "position_offset_rad", units.position_offset_rad);
  units.torque_at_joint = section.choice("torque_side", {"motor", "joint"}) == "joint";
  units.gear_ratio = joint.plant.gear_ratio;
}

// In position mode the frame also carries a velocity and a torque, each of 16 bits.
void require_order_fits(TomlSection& section, const JointConfig& joint, odrive::DriveConfig& drive) {
  drive.units.velocity_units_per_turn_s =
      section.number_or("input_vel_scale", drive.units.velocity_units_per_turn_s, {1.0, 1e6});
  if (drive.drive_mode != DriveMode::kPosition) return;
  const double speed_rad_s = joint.loop.controller.motion.velocity_rad_s;
  const double turns_s = std::abs(odrive::drive_turns(drive.units, speed_rad_s));
  if (turns_s * drive.units.velocity_units_per_turn_s > odrive::kMostUnits)
    section.fail("input_vel_scale", "at most " + number_text(std::floor(odrive::kMostUnits / turns_s)) +
                                        " is allowed with speed_limit_rad_s = " + number_text(speed_rad_s) +
                                        ": set it here, and axis0.config.can.input_vel_scale in the drive");
  const double torque_Nm =
      std::abs(odrive::drive_torque_Nm(drive.units, drive.torque_limit_Nm, drive.torque_limit_Nm));
  if (torque_Nm * odrive::kTorqueUnitsPerNm > odrive::kMostUnits)
    section.fail("drive_mode", "only \"velocity\" or \"torque\" is allowed with " + number_text(torque_Nm) +
                                   " N.m at the drive: \"position\" allows at most " +
                                   number_text(odrive::kMostUnits / odrive::kTorqueUnitsPerNm));
}

}  // namespace

odrive::DriveConfig read_odrive(TomlSection& section, int node_id, double period_s, JointConfig& joint) {
  odrive::DriveConfig drive;
  drive.name = joint.name;
  drive.node_id = static_cast<std::uint8_t>(node_id);
  drive.period_s = period_s;
  drive.torque_limit_Nm = joint.loop.controller.torque_limit_Nm;
  read_units(section, joint, drive.units);
  drive.drive_mode = read_drive_mode(section, joint);
  require_order_fits(section, joint, drive);
  drive.absolute_encoder = section.choice("encoder", {"absolute", "incremental"}) == "absolute";
  drive.heartbeat_period_s = section.number_or("drive_heartbeat_s", drive.heartbeat_period_s, kRates_s);
  drive.heartbeat_timeout_s = section.number_or("drive_heartbeat_timeout_s", 3.5 * drive.heartbeat_period_s,
                                                {drive.heartbeat_period_s, 60.0});
  drive.zero_torque_after =
      static_cast<int>(section.integer_or("zero_torque_after", drive.zero_torque_after, 0, 100));
  const int fault_after = std::max(drive.fault_after, drive.zero_torque_after);
  drive.fault_after =
      static_cast<int>(section.integer_or("fault_after", fault_after, drive.zero_torque_after, 1000));
  drive.arm_timeout_s = section.number_or("arm_timeout_s", drive.arm_timeout_s, {0.01, 60.0});
  drive.temperature = read_temperature_source(section);
  drive.temperature_period_s = section.number_or("temperature_s", drive.temperature_period_s, kRates_s);
  drive.max_watchdog_s = section.number_or("max_watchdog_s", drive.max_watchdog_s, {2.0 * period_s, 10.0});
  if (section.has("watchdog")) drive.watchdog = read_watchdog(section.section("watchdog"));

  JointControllerConfig& controller = joint.loop.controller;
  const double counts = section.number("encoder_counts_per_joint_turn", {1.0, 1e10});
  controller.encoder_resolution_rad = kTurn_rad / counts;
  // The drive's own loop takes an order as soon as the frame arrives, hence 0. The drive samples its encoder by its own clock, so
  // torque mode assumes the longest delay, one period.
  controller.delay_periods = static_cast<int>(
      section.integer_or("delay_periods", closes_loop(drive.drive_mode) ? 0 : 1, 0, kMaxControlDelay));
  TomlSection motor = section.section("motor");
  controller.motor =
      read_motor_limits(motor, read_motor_constants(motor), drive.units.gear_ratio, drive.torque_limit_Nm);
  motor.refuse_unknown_keys();
  joint.drive_error_text = [](Fault /*fault*/, std::uint32_t drive_error) {
    return odrive::drive_error_text(drive_error);
  };
  return drive;
}

}  // namespace strainwave
