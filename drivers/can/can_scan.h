// SPDX-License-Identifier: BSD-3-Clause
// Lists the nodes of a CAN bus: every CANopen node that answers, its identity, its modes, and objects with a
// possible temperature. It only reads, by SDO, and gives no orders. Blocking; not real-time.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/can/can_port.h"

namespace strainwave {

struct ScannedNode {
  std::uint8_t node_id = 0;
  std::uint32_t device_type = 0;
  std::string identity;             ///< in words
  std::string modes;                ///< of a servo drive; empty for another device
  std::vector<std::string> mapped;  ///< objects in its TPDOs, as index:sub and bits
  std::vector<std::string>
      temperatures;     ///< objects with a known vendor-specific temperature, and their value
  std::string trouble;  ///< why the rest could not be read; empty: nothing
};

/// Asks the nodes 1..127 one after the other, each for `timeout_ns`.
std::vector<ScannedNode> scan_can_bus(const CanPortFactory& open, std::int64_t timeout_ns);

/// The same on an interface of this machine. Throws InputError when it cannot be used.
std::vector<ScannedNode> scan_can_interface(const std::string& interface_name);

}  // namespace strainwave
