// The configuration file of strainwaved: TOML, read once at start, strict. A value that exists is valid. Not real-time.
// docs/configuration.md lists every key.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "control/gain_table.h"
#include "daemon/admission/authorized_keys.h"
#include "daemon/gateway/gateway_user.h"
#include "daemon/realtime/joint_loop.h"
#include "daemon/realtime/loop_parts.h"
#include "daemon/records/flight_record_writer.h"
#include "drivers/actuator.h"
#include "drivers/fieldbus.h"
#include "drivers/temperature_file.h"

namespace strainwave {

/// What ActuatorReading::drive_error says with `fault`, in words.
using DriveErrorText = std::string (*)(Fault fault, std::uint32_t drive_error);

/// Makes the joint's driver; called once, before the loop runs. Throws InputError.
using ActuatorFactory = std::function<std::unique_ptr<Actuator>()>;

struct JointConfig {
  std::string name;
  PlantIdentity plant;
  JointLoopConfig loop;
  std::string driver;
  std::string group;  ///< name of the joints that stop together; empty: none
  bool takes_injected_faults = false;
  std::string driver_resource;  ///< what only one daemon may use ("can0 node 3"); empty: nothing shared
  std::optional<TemperatureFileConfig> thermometer;  ///< beside what the drive itself measures
  ActuatorFactory make_actuator;  ///< of a drive of its own; unused when `bus` says which bus makes it
  /// Tells of the drive's digital lines without touching outputs; false when one is not usable. Null: it has none.
  std::function<bool(std::ostream&)> describe_lines;
  /// Start-up against a drive's electronic data sheet; lines for the user. Throws InputError. Null: its drives have none.
  std::function<std::vector<std::string>(const std::filesystem::path&)> check_data_sheet;
  DriveErrorText drive_error_text = nullptr;  ///< null: its drive has no numbers of its own
  int bus = -1;                               ///< index in DaemonConfig::buses; -1: on none
  std::size_t bus_slot = 0;                   ///< the drive's place on that bus
  std::filesystem::path table;                ///< initial gain table; empty: none
};

/// What several joints share.
struct BusConfig {
  std::string name;
  FieldbusFactory make_bus;
};

struct DaemonConfig {
  LoopConfig loop;
  RecorderConfig recorder;
  std::string prefix;
  std::string lcm_url;
  GatewayUser gateway_user;
  SecurityPolicy security;
  std::vector<BusConfig> buses;
  std::vector<JointConfig> joints;
};

/// Reads `path`. Throws InputError naming file, line, key, value and what is allowed: unreadable or malformed file,
/// unknown, missing or repeated keys, impossible values, joints of the same name.
DaemonConfig read_config(const std::filesystem::path& path);

}  // namespace strainwave
