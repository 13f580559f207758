// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/can_scan.h"

#include <algorithm>
#include <array>

#include "base/printable.h"
#include "drivers/can/can_interface.h"
#include "drivers/can/can_socket.h"
#include "drivers/can/canopen/sdo_client.h"
#include "drivers/can/cia402/cia402_description.h"

namespace strainwave {

namespace {

using canopen::Entry;
using canopen::SdoClient;

constexpr std::int64_t kAskTimeout_ns = 30'000'000;
constexpr std::int64_t kReadTimeout_ns = 500'000'000;
constexpr std::uint16_t kFirstTransmitMapping = 0x1A00;
constexpr std::uint16_t kTransmitPdos = 4;
constexpr std::uint8_t kMostMappedObjects = 8;

struct KnownTemperature {
  Entry entry;
  const char* who;
};
/// Vendors' objects, from their manuals. The manual says which sensor it is.
constexpr std::array kKnownTemperatures{
    KnownTemperature{{0x3201, 1}, "maxon EPOS4: power stage, 0.1 degC"},
    KnownTemperature{{0x22A3, 1}, "Elmo Gold: drive, 1 degC"},
    KnownTemperature{{0x22A3, 2}, "Elmo Gold: 1 degC"},
    KnownTemperature{{0x22A3, 3}, "Elmo Gold: 1 degC"},
    KnownTemperature{{0x200D, 1}, "Schunk, Pilz: module, REAL32 degC, renewed every 20 s"},
};

void read_mapping(SdoClient& client, ScannedNode& node) {
  for (std::uint16_t pdo = 0; pdo < kTransmitPdos; ++pdo) {
    const auto index = static_cast<std::uint16_t>(kFirstTransmitMapping + pdo);
    const auto count = client.upload_if_there({index, 0}, 1);
    for (std::uint8_t i = 1; count && i <= std::min<std::uint64_t>(*count, kMostMappedObjects); ++i) {
      const std::uint64_t word = client.upload_number({index, i}, 4);
      const Entry entry{static_cast<std::uint16_t>(word >> 16U), static_cast<std::uint8_t>(word >> 8U)};
      node.mapped.push_back("TPDO" + std::to_string(pdo + 1) + " " + to_text(entry) + " " +
                            std::to_string(word & 0xFFU) + " bit");
    }
  }
}

void read_temperatures(SdoClient& client, ScannedNode& node) {
  for (const KnownTemperature& known : kKnownTemperatures) {
    try {
      const std::vector<std::uint8_t> value = client.upload(known.entry);
      if (value.size() > 4) continue;
      std::string line = to_text(known.entry) + " (" + known.who + "): raw " +
                         std::to_string(little_endian(value.data(), value.size())) + ", " +
                         counted(value.size(), "byte");
      node.temperatures.push_back(std::move(line));
    } catch (const canopen::SdoError& error) {
      if (!error.no_such_entry()) throw;
    }
  }
}

void describe_node(SdoClient& client, ScannedNode& node) {
  const cia402::Description found = cia402::describe(client);
  node.identity = cia402::to_text(found);
  if (cia402::is_servo_drive(found))
    node.modes = found.supported_modes ? cia402::modes_text(*found.supported_modes)
                                       : "unknown, the drive has no 6502h";
  read_mapping(client, node);
  read_temperatures(client, node);
}

}  // namespace

std::vector<ScannedNode> scan_can_bus(const CanPortFactory& open, std::int64_t timeout_ns) {
  CanPortOptions options;
  for (std::uint8_t id = 1; id <= canopen::kMaxNodeId; ++id)
    options.receive_ids.push_back(cob_id(canopen::CobId::kSdoAnswer, id));
  const std::unique_ptr<CanPort> port = open(options);
  std::vector<ScannedNode> nodes;
  for (std::uint8_t id = 1; id <= canopen::kMaxNodeId; ++id) {
    ScannedNode node;
    node.node_id = id;
    try {
      node.device_type =
          static_cast<std::uint32_t>(SdoClient(*port, id, "scan", timeout_ns).upload_number({0x1000, 0}, 4));
    } catch (const canopen::SdoError&) {
      continue;  // no node there, or no CANopen device
    }
    try {
      SdoClient client(*port, id, "scan", kReadTimeout_ns);
      describe_node(client, node);
    } catch (const canopen::SdoError& error) {
      node.trouble = error.what();
    }
    nodes.push_back(std::move(node));
  }
  return nodes;
}

std::vector<ScannedNode> scan_can_interface(const std::string& interface_name) {
  const CanInterface interface = inspect_can_interface(interface_name);
  // Accepts the interface's present bit rate, because a scan shall find the right one.
  (void)require_can_interface(interface_name, interface, interface.bit_rate.value_or(0), 1);
  return scan_can_bus(
      [&](const CanPortOptions& options) { return std::make_unique<CanSocket>(interface_name, options); },
      kAskTimeout_ns);
}

}  // namespace strainwave
