// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/drive_check.h"

#include "base/input_error.h"
#include "drivers/can/cia402/eds_check.h"

namespace strainwave {

namespace {

/// Returns null when the joint has no CiA 402 drive.
const cia402::DriveConfig* cia402_drive(const DaemonConfig& config, const JointConfig& joint) {
  const auto* const place = std::get_if<DriveOnBus>(&joint.drive);
  return place == nullptr ? nullptr
                          : std::get_if<cia402::DriveConfig>(&config.buses[place->bus].drives[place->slot]);
}

}  // namespace

std::vector<InstanceLock> lock_drives(const DaemonConfig& config) {
  std::vector<InstanceLock> locks;
  for (const JointConfig& joint : config.joints)
    if (!joint.driver_resource.empty())
      locks.emplace_back("drive " + joint.driver_resource, "a drive has one master; stop the other daemon");
  return locks;
}

bool check_drives(const DaemonConfig& config, std::ostream& out, const BusOpener& open) {
  const std::vector<InstanceLock> locks = lock_drives(config);
  bool good = true;
  for (const BusConfig& bus : config.buses) {
    try {
      const std::unique_ptr<Fieldbus> made = open(bus);
      for (const std::string& line : made->take_messages()) out << line << '\n';
      out << bus.name << ": start-up would accept every drive\n";
    } catch (const InputError& error) {
      out << bus.name << ": refused: " << error.what() << '\n';
      good = false;
    }
  }
  if (config.buses.empty()) out << "no joint is on a bus\n";
  return good;
}

bool check_lines(const DaemonConfig& config, std::ostream& out) {
  bool good = true;
  bool any = false;
  for (const JointConfig& joint : config.joints) {
    const auto* const gpio = std::get_if<GpioJointConfig>(&joint.drive);
    if (gpio == nullptr) continue;
    any = true;
    good = report_lines(*gpio, out) && good;
  }
  if (!any) out << "no joint of this configuration has digital lines\n";
  return good;
}

bool check_data_sheet(const DaemonConfig& config, const std::filesystem::path& file, std::ostream& out) {
  bool good = true;
  bool checked = false;
  for (const JointConfig& joint : config.joints) {
    const cia402::DriveConfig* const drive = cia402_drive(config, joint);
    if (drive == nullptr) continue;
    checked = true;
    try {
      for (const std::string& line :
           cia402::check_data_sheet(canopen::read_eds(file, drive->node_id), *drive))
        out << line << '\n';
      out << joint.name << ": start-up would accept a drive with this data sheet\n";
    } catch (const InputError& error) {
      out << joint.name << ": refused: " << error.what() << '\n';
      good = false;
    }
  }
  if (!checked) out << "no joint has a drive with an electronic data sheet\n";
  return good && checked;
}

}  // namespace strainwave
