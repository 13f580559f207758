// SPDX-License-Identifier: BSD-3-Clause
// State of a CAN interface from the kernel: whether it is up, its bit rate, its queue. Not real-time. Source:
// netdevice(7), linux/can/netlink.h.
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
  std::string kind;                         ///< "can", "vcan", ...; empty when the kernel does not report it
  std::optional<std::uint32_t> bit_rate;    ///< of a real controller
  std::optional<std::uint32_t> restart_ms;  ///< 0: no automatic restart after bus-off, as required
};

/// Throws std::system_error only when the kernel cannot be queried at all.
CanInterface inspect_can_interface(const std::string& name);

/// Reads the link attributes of a netlink RTM_NEWLINK answer, which follow its ifinfomsg. Public for tests.
void read_link_attributes(std::span<const std::byte> attributes, CanInterface& interface);

/// Throws InputError with the problem and the command that fixes it. Problems are: absent, down, another bit rate than
/// `bit_rate`, an automatic restart, a transmit queue of fewer than `frames_per_cycle` frames. A controller's clock may
/// not divide to the exact rate: within half a per cent it is accepted. Returns lines for the log.
std::vector<std::string> require_can_interface(const std::string& name, const CanInterface& interface,
                                               std::uint32_t bit_rate, int frames_per_cycle);

}  // namespace strainwave
