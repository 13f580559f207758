// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/can_drive.h"

#include "drivers/can/can_interface.h"
#include "drivers/can/can_socket.h"
#include "drivers/can/cia402/cia402_node.h"
#include "drivers/can/odrive/odrive_node.h"

namespace strainwave {

namespace {

/// Frames in addition to a period's orders and SYNC: a heartbeat, an SDO and its abort.
constexpr int kSpareFrames = 3;

std::unique_ptr<CanNode> make_node(const cia402::DriveConfig& drive) {
  return std::make_unique<cia402::Node>(drive);
}

std::unique_ptr<CanNode> make_node(const odrive::DriveConfig& drive) {
  return std::make_unique<odrive::Node>(drive);
}

}  // namespace

std::vector<std::unique_ptr<CanNode>> make_nodes(const std::vector<CanDrive>& drives) {
  std::vector<std::unique_ptr<CanNode>> nodes;
  nodes.reserve(drives.size());
  for (const CanDrive& drive : drives)
    nodes.push_back(std::visit([](const auto& config) { return make_node(config); }, drive));
  return nodes;
}

std::unique_ptr<Fieldbus> open_can_bus(const CanBusConfig& config, const std::vector<CanDrive>& drives) {
  const int frames = static_cast<int>(drives.size()) + 1 + kSpareFrames;
  const std::vector<std::string> notes = require_can_interface(
      config.interface_name, inspect_can_interface(config.interface_name), config.bit_rate, frames);
  auto bus = std::make_unique<CanBus>(config, make_nodes(drives), [config](const CanPortOptions& options) {
    return std::make_unique<CanSocket>(config.interface_name, options);
  });
  bus->say(notes);
  return bus;
}

}  // namespace strainwave
