// SPDX-License-Identifier: BSD-3-Clause
// What the kernel says of a CAN interface before it is used: whether it is up, its bit rate, its queue. Not
// real-time. Source: netdevice(7), linux/can/netlink.h.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace strainwave {

struct CanInterface {
  bool exists = false;
  bool is_can = false;
  bool up = false;
  int transmit_queue_frames = 0;
  std::string kind;                         ///< "can", "vcan", ...; empty when the kernel did not say
  std::optional<std::uint32_t> bit_rate;    ///< of a real controller
  std::optional<std::uint32_t> restart_ms;  ///< 0: stays off the bus after bus-off, as it should
};

/// Throws std::system_error only when the kernel cannot be asked at all.
CanInterface inspect_can_interface(const std::string& name);

/// The link's part of a netlink answer of RTM_NEWLINK: the attributes behind its ifinfomsg. For tests as well.
void read_link_attributes(std::span<const std::byte> attributes, CanInterface& interface);

/// Throws InputError that says what is wrong and the command that mends it: absent, down, another bit rate than `bit_rate`, an
/// automatic restart, or a transmit queue of fewer than `frames_per_cycle` frames. A controller's clock may not divide to the exact
/// rate: within half a per cent it is accepted. Returns lines for the log.
std::vector<std::string> require_can_interface(const std::string& name, const CanInterface& interface,
                                               std::uint32_t bit_rate, int frames_per_cycle);

}  // namespace strainwave
