// SPDX-License-Identifier: BSD-3-Clause
// [[can_bus]] and [joint.can] of the configuration: drives on CAN buses. Not real-time.
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
  /// Reads every [[can_bus]]; there may be none. Drives miss their orders after `stall_s`. Throws InputError.
  CanConfig(TomlSection& root, double period_s, double stall_s);

  /// Reads [joint.can]: puts the drive on its bus, and sets what depends on the driver. Returns what the joint can be homed
  /// by. Throws InputError.
  HomingInputs read_joint(TomlSection& section, JointConfig& joint);

  /// After all joints: the buses. Throws InputError for a bus without joints, or one that would be
  /// too full.
  std::vector<BusConfig> buses() const;

 private:
  struct Bus {
    std::string name;
    TomlSection section;
    CanBusConfig config;
    bool drive_makes_sync = false;  ///< sync = "drive"
    std::vector<int> node_ids;      ///< of the drives so far
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
