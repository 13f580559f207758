// SPDX-License-Identifier: BSD-3-Clause
// Reads [[can_bus]] and [joint.can] of the configuration: drives on CAN buses. Not real-time.
#pragma once

#include <string>
#include <vector>

#include "base/toml_section.h"
#include "daemon/config/config.h"
#include "daemon/config/config_homing.h"
#include "drivers/can/can_drive.h"

namespace strainwave {

/// The buses of a configuration file and the drives on them.
class CanConfig {
 public:
  /// Reads every [[can_bus]]; there may be none. `stall_s` becomes the drives' deadline for orders. Throws InputError.
  CanConfig(TomlSection& root, double period_s, double stall_s);

  /// Reads [joint.can]: adds the drive to its bus, and sets the values that depend on the driver. Returns the inputs for
  /// homing. Throws InputError.
  HomingInputs read_joint(TomlSection& section, JointConfig& joint);

  /// Returns the buses; call it after all joints. Throws InputError for a bus without joints, or with too much traffic.
  std::vector<BusConfig> buses() const;

 private:
  struct Bus {
    std::string name;
    TomlSection section;
    CanBusConfig config;
    bool drive_makes_sync = false;  ///< sync = "drive"
    std::vector<int> node_ids;      ///< of the drives read so far
    std::vector<CanDrive> drives;
    bool has_sync_drive = false;
  };
  Bus& find_bus(TomlSection& section);
  HomingInputs read_cia402(TomlSection& section, Bus& bus, int node_id, JointConfig& joint);

  double period_s_;
  double stall_s_;
  std::vector<Bus> buses_;
};

}  // namespace strainwave
