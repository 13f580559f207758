#include "daemon/drive_check.h"

#include "base/input_error.h"

namespace strainwave {

std::vector<InstanceLock> lock_drives(const DaemonConfig& config) {
  std::vector<InstanceLock> locks;
  for (const JointConfig& joint : config.joints)
    if (!joint.driver_resource.empty())
      locks.emplace_back("drive " + joint.driver_resource, "a drive has one master; stop the other daemon");
  return locks;
}

bool check_drives(const DaemonConfig& config, std::ostream& out) {
  const std::vector<InstanceLock> locks = lock_drives(config);
  bool good = true;
  for (const BusConfig& bus : config.buses) {
    try {
      const std::unique_ptr<Fieldbus> made = bus.make_bus();
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

bool check_data_sheet(const DaemonConfig& config, const std::filesystem::path& file, std::ostream& out) {
  bool good = true;
  bool checked = false;
  for (const JointConfig& joint : config.joints) {
    if (!joint.check_data_sheet) continue;
    checked = true;
    try {
      for (const std::string& line : joint.check_data_sheet(file)) out << line << '\n';
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
