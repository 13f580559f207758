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

}  // namespace strainwave
