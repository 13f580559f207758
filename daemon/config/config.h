// SPDX-License-Identifier: BSD-3-Clause
// Reads the configuration file of strainwaved (TOML) once at start. Unknown keys are errors, and all values in it are valid. Not real-time.
// docs/configuration.md lists every key.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/protected_file.h"
#include "control/table/gain_table.h"
#include "daemon/admission/authorized_keys.h"
#include "daemon/gateway/gateway_user.h"
#include "daemon/realtime/joint/joint_loop.h"
#include "daemon/realtime/loop/loop_parts.h"
#include "daemon/records/flight_record_writer.h"
#include "drivers/can/can_drive.h"
#include "drivers/faulty_actuator.h"
#include "drivers/gpio/gpio_joint.h"
#include "drivers/simulated_actuator.h"
#include "drivers/temperature_file.h"

namespace strainwave {

/// Explains ActuatorReading::drive_error, which came with `fault`, in words.
using DriveErrorText = std::string (*)(Fault fault, std::uint32_t drive_error);

struct SimulatedDrive {
  SimulatedActuatorConfig actuator;
  FaultyActuatorConfig faults;  ///< injected into the drive
};

/// A drive is configured with its bus.
struct DriveOnBus {
  std::size_t bus = 0;   ///< index in DaemonConfig::buses
  std::size_t slot = 0;  ///< index in BusConfig::drives
};

struct JointConfig {
  std::string name;
  PlantIdentity plant;
  JointLoopConfig loop;
  std::string driver;
  std::string group;  ///< name of the joints that stop together; empty: none
  bool takes_injected_faults = false;
  std::string driver_resource;  ///< resource that only one daemon may use ("can0 node 3"); empty: none
  std::optional<TemperatureFileConfig> thermometer;  ///< sensor in addition to the drive's own
  std::variant<SimulatedDrive, GpioJointConfig, DriveOnBus> drive;
  DriveErrorText drive_error_text = nullptr;  ///< null: the drive has no error numbers
  std::filesystem::path table;                ///< initial gain table; empty: none
  bool motor_inertia_assumed = false;         ///< not in the file (ConfigUse::kCommission)
  bool load_inertia_assumed = false;
  std::string table_place;  ///< place in the file, for messages: "arm.toml:14: joint[0].table = "t.json""
};

/// A bus that several joints share.
struct BusConfig {
  std::string name;
  CanBusConfig config;
  std::vector<CanDrive> drives;
};

struct DaemonConfig {
  LoopConfig loop;
  RecorderConfig recorder;
  std::string prefix;
  std::string lcm_url;
  GatewayUser gateway_user;
  std::string gateway_socket;  ///< socket where the service manager starts gateways; empty: the daemon does
  std::filesystem::path state_directory;  ///< folder for learned friction; empty: not kept
  SecurityPolicy security;
  std::vector<BusConfig> buses;
  std::vector<JointConfig> joints;
  std::vector<std::string> warnings;  ///< values that are probably wrong (config_doubts.h)
};

/// Returns which users, in addition to root and our own user, may write the configuration and the table of `joint`.
Writers writers_allowed(const JointConfig& joint);

/// Purpose of reading a configuration. Only kRun reads the security settings. With kCommission a joint with a catalogue gear may lack
/// its inertias: the motor then gets the inertia of the wave generator, and the load gets the motor's.
enum class ConfigUse : std::uint8_t { kRun, kCheckDrives, kCommission };

/// Reads `path`. Throws InputError for an unreadable or malformed file, unknown, missing or repeated keys, impossible values, and joints
/// of the same name. Each error has a line with file, line, key, value and what is allowed.
DaemonConfig read_config(const std::filesystem::path& path, ConfigUse use = ConfigUse::kRun);

}  // namespace strainwave
