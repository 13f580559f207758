// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/start_check.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>

#include "base/input_error.h"
#include "base/printable.h"
#include "daemon/gateway/gateway_process.h"
#include "daemon/initial_table.h"
#include "daemon/realtime/loop/realtime_setup.h"
#include "lcmtypes/multicast_check.h"

namespace strainwave {

namespace {

void tell_table(const JointConfig& joint, const std::optional<InitialTable>& initial, std::ostream& out) {
  if (!initial) {
    out << joint.name << ": no gain table: load one before enable\n";
    return;
  }
  for (const std::string& doubt : initial->doubts) out << "warning: " << doubt << '\n';
  out << joint.name << ": table '" << initial->table.name.view() << "': " << initial->verdict << '\n';
}

void tell_loads(const JointConfig& joint, const std::optional<InitialTable>& initial, std::ostream& out) {
  const JointControllerConfig& controller = joint.loop.controller;
  const double torque_limit_Nm =
      initial ? controller.torque_limit_with(initial->table) : controller.torque_limit_Nm;
  const LoadLimits loads = joint.loop.limits.load.under(torque_limit_Nm);
  out << joint.name << ": yields to a load above " << loads.load_Nm << " N.m, notice above "
      << loads.notice_Nm << ", torque limit " << torque_limit_Nm << '\n';
}

/// Only a warning: the service's cpuset may differ from this process's.
void check_processor(const DaemonConfig& config, std::ostream& out) {
  if (const std::string problem = processor_problem(config.loop.cpu); !problem.empty())
    out << "warning: " << problem << '\n';
}

void check_gateway(const DaemonConfig& config, std::ostream& out) {
  if (const std::filesystem::path program = find_gateway_program(); !std::filesystem::exists(program))
    throw InputError(program.string() + ": the daemon's gateway is missing: install it again");
  // Only a warning: the service has the route made before it starts.
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
  for (const JointConfig& joint : config.joints) {
    const std::optional<InitialTable> initial = read_initial_table(joint);
    tell_table(joint, initial, out);
    tell_loads(joint, initial, out);
  }
  check_processor(config, out);
  check_gateway(config, out);
  out << "not checked:";
  if (has_driver(config, "can")) out << " drives on CAN (strainwavectl can-check),";
  if (has_driver(config, "gpio")) out << " digital lines (strainwavectl gpio-check),";
  if (config.loop.real_time == RealTimePolicy::kEnforce) out << " real-time privileges,";
  out << " whether another daemon has the prefix or a drive\n";
}

}  // namespace strainwave
