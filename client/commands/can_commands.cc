// SPDX-License-Identifier: BSD-3-Clause
// can-scan: lists the nodes on a CAN bus, without a running daemon.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/printable.h"
#include "client/commands/commands.h"
#include "drivers/can/can_scan.h"

namespace strainwave {

namespace {

std::string text_of(const ScannedNode& node) {
  std::string text = fmt::format("node {}: device type {:08X}h", node.node_id, node.device_type);
  if (!node.identity.empty()) text += ", " + node.identity;
  text += '\n';
  if (!node.modes.empty()) text += "  modes: " + node.modes + '\n';
  for (const std::string& object : node.mapped) text += "  sends " + object + '\n';
  for (const std::string& object : node.temperatures) text += "  temperature? " + object + '\n';
  if (!node.trouble.empty()) text += "  " + node.trouble + '\n';
  return text;
}

nlohmann::ordered_json json_of(const ScannedNode& node) {
  return {{"node", node.node_id},      {"device_type", node.device_type},
          {"identity", node.identity}, {"modes", node.modes},
          {"sends", node.mapped},      {"temperatures", node.temperatures},
          {"trouble", node.trouble}};
}

}  // namespace

void can_scan(const Output& output, const std::string& interface_name) {
  const std::vector<ScannedNode> nodes = scan_can_interface(interface_name);
  if (output.json) {
    nlohmann::ordered_json found{{"interface", interface_name}, {"nodes", nlohmann::ordered_json::array()}};
    for (const ScannedNode& node : nodes) found["nodes"].push_back(json_of(node));
    // Identities come from devices and may hold invalid UTF-8, which dump() replaces.
    output.stream << found.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
    return;
  }
  for (const ScannedNode& node : nodes) output.stream << text_of(node);
  output.stream << interface_name << ": " << counted(nodes.size(), "CANopen node") << " answered"
                << (nodes.empty() ? "; check bit rate, termination, and the drives' supply" : "") << '\n';
}

}  // namespace strainwave
