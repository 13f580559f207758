#include "daemon/start_check.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "base/input_error.h"
#include "base/printable.h"
#include "daemon/gateway/gateway_process.h"
#include "daemon/initial_table.h"
#include "lcmtypes/multicast_check.h"

namespace strainwave {

namespace {

void check_tables(const DaemonConfig& config, std::ostream& out) {
  for (const JointConfig& joint : config.joints) {
    const auto initial = read_initial_table(joint);
    if (!initial) {
      out << joint.name << ": no table: it can be enabled once one is loaded\n";
      continue;
    }
    for (const std::string& doubt : initial->doubts) out << "warning: " << doubt << '\n';
    out << joint.name << ": table '" << initial->table.name.view() << "': " << initial->verdict << '\n';
  }
}

void tell_loads(const DaemonConfig& config, std::ostream& out) {
  for (const JointConfig& joint : config.joints) {
    const JointLimits& limits = joint.loop.limits;
    out << joint.name << ": yields to a load above " << limits.load_Nm << " N.m, notice above "
        << limits.load_notice_Nm << ", torque limit " << joint.loop.controller.torque_limit_Nm << '\n';
  }
}

void check_gateway(const DaemonConfig& config, std::ostream& out) {
  if (const std::filesystem::path program = find_gateway_program(); !std::filesystem::exists(program))
    throw InputError(program.string() + ": the daemon's gateway is missing: install it again");
  // No matter of the configuration: the service has the route made before it starts.
  if (const auto problem = find_multicast_problem(config.lcm_url))
    out << "warning: daemon.lcm_url = \"" << printable(config.lcm_url) << "\": " << *problem
        << "\nThe service does this by itself (strainwave-multicast.service).\n";
}

bool has_driver(const DaemonConfig& config, std::string_view driver) {
  return std::any_of(config.joints.begin(), config.joints.end(),
                     [&](const JointConfig& joint) { return joint.driver == driver; });
}

}  // namespace

void check_start(const DaemonConfig& config, std::ostream& out) {
  for (const std::string& warning : config.warnings)
    out << "warning: " << printable_paragraph(warning) << '\n';
  check_tables(config, out);
  tell_loads(config, out);
  check_gateway(config, out);
  out << "not checked:";
  if (has_driver(config, "can")) out << " drives on CAN (strainwavectl can-check),";
  if (has_driver(config, "gpio")) out << " digital lines (strainwavectl gpio-check),";
  if (config.loop.real_time == RealTimePolicy::kEnforce) out << " real-time privileges,";
  out << " whether another daemon has the prefix or a drive\n";
}

}  // namespace strainwave
