// SPDX-License-Identifier: BSD-3-Clause
// The configuration file of strainwaved: TOML, read once at start, strict. A value that exists is valid. Not real-time.
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

/// What ActuatorReading::drive_error says with `fault`, in words.
using DriveErrorText = std::string (*)(Fault fault, std::uint32_t drive_error);

struct SimulatedDrive {
  SimulatedActuatorConfig actuator;
  FaultyActuatorConfig faults;  ///< that it is given
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
  std::string driver_resource;  ///< what only one daemon may use ("can0 node 3"); empty: nothing shared
  std::optional<TemperatureFileConfig> thermometer;  ///< beside what the drive itself measures
  std::variant<SimulatedDrive, GpioJointConfig, DriveOnBus> drive;
  DriveErrorText drive_error_text = nullptr;  ///< null: its drive has no numbers of its own
  std::filesystem::path table;                ///< initial gain table; empty: none
  bool motor_inertia_assumed = false;         ///< it is not in the file (ConfigUse::kCommission)
  bool load_inertia_assumed = false;
  std::string
      table_place;  ///< where the file names it, for messages: "arm.toml:14: joint[0].table = "t.json""
};

/// What several joints share.
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
  std::string gateway_socket;  ///< where the service manager starts gateways; empty: the daemon does
  std::filesystem::path state_directory;  ///< where learned friction is kept; empty: nowhere
  SecurityPolicy security;
  std::vector<BusConfig> buses;
  std::vector<JointConfig> joints;
  std::vector<std::string> warnings;  ///< what the file may say and yet rarely means (config_doubts.h)
};

/// Who besides root and our own user may write what decides about `joint`: the configuration and its table.
Writers writers_allowed(const JointConfig& joint);

/// What a configuration is read for: only who runs it needs to know who may give orders. A joint with a gear that is to be commissioned
/// may be without its inertias: the wave generator's is assumed, for motor and load each.
enum class ConfigUse : std::uint8_t { kRun, kCheckDrives, kCommission };

/// Reads `path`. Throws InputError with a line for each error, naming file, line, key, value and what is allowed: unreadable or
/// malformed file, unknown, missing or repeated keys, impossible values, joints of the same name.
DaemonConfig read_config(const std::filesystem::path& path, ConfigUse use = ConfigUse::kRun);

}  // namespace strainwave
