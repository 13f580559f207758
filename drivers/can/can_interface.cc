// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/can_interface.h"

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <net/if_arp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <system_error>

#include "base/input_error.h"
#include "base/unique_fd.h"

namespace strainwave {

namespace {

/// Resynchronization tolerates about 1 % between two nodes (ISO 11898-1); each node may use half of it.
constexpr double kRateTolerance = 0.005;
/// NLA_TYPE_MASK, which is negative as an int.
constexpr std::uint16_t kTypeMask = 0x3FFF;

using AttributeVisitor = std::function<void(std::uint16_t type, std::span<const std::byte> value)>;

/// Calls `visit` for each attribute; stops at a length that does not fit.
void walk_attributes(std::span<const std::byte> bytes, const AttributeVisitor& visit) {
  while (bytes.size() >= sizeof(rtattr)) {
    rtattr header{};
    std::memcpy(&header, bytes.data(), sizeof header);
    if (header.rta_len < sizeof header || header.rta_len > bytes.size()) return;
    const std::size_t offset = RTA_LENGTH(0);
    visit(header.rta_type & kTypeMask, bytes.subspan(offset, header.rta_len - offset));
    bytes = bytes.subspan(std::min<std::size_t>(RTA_ALIGN(header.rta_len), bytes.size()));
  }
}

std::optional<std::uint32_t> first_number(std::span<const std::byte> value) {
  if (value.size() < sizeof(std::uint32_t)) return std::nullopt;
  std::uint32_t number = 0;
  std::memcpy(&number, value.data(), sizeof number);
  return number;
}

void read_can_data(std::span<const std::byte> data, CanInterface& interface) {
  walk_attributes(data, [&](std::uint16_t type, std::span<const std::byte> value) {
    // can_bittiming begins with its bit rate.
    if (type == IFLA_CAN_BITTIMING) interface.bit_rate = first_number(value);
    if (type == IFLA_CAN_RESTART_MS) interface.restart_ms = first_number(value);
  });
}

bool ask(int socket, unsigned long request, const std::string& name, ifreq& answer) {
  answer = {};
  name.copy(answer.ifr_name, IFNAMSIZ - 1);
  return ::ioctl(socket, request, &answer) == 0;
}

// Only netlink reports the bit rate. A service that may not open such sockets leaves it unknown.
void ask_netlink(const std::string& name, CanInterface& interface) {
  const UniqueFd socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  if (socket.get() < 0) return;
  struct {
    nlmsghdr header;
    ifinfomsg link;
  } request{};
  request.header.nlmsg_len = sizeof request;
  request.header.nlmsg_type = RTM_GETLINK;
  request.header.nlmsg_flags = NLM_F_REQUEST;
  request.link.ifi_index = static_cast<int>(::if_nametoindex(name.c_str()));
  if (::send(socket.get(), &request, sizeof request, 0) != sizeof request) return;
  std::array<std::byte, 16384> answer{};
  const ssize_t got = ::recv(socket.get(), answer.data(), answer.size(), 0);
  if (got < static_cast<ssize_t>(NLMSG_LENGTH(sizeof(ifinfomsg)))) return;
  nlmsghdr header{};
  std::memcpy(&header, answer.data(), sizeof header);
  if (header.nlmsg_type != RTM_NEWLINK || header.nlmsg_len > static_cast<std::size_t>(got)) return;
  const std::size_t offset = NLMSG_LENGTH(NLMSG_ALIGN(sizeof(ifinfomsg)));
  if (header.nlmsg_len >= offset)
    read_link_attributes(std::span(answer).subspan(offset, header.nlmsg_len - offset), interface);
}

}  // namespace

void read_link_attributes(std::span<const std::byte> attributes, CanInterface& interface) {
  walk_attributes(attributes, [&](std::uint16_t type, std::span<const std::byte> value) {
    if (type != IFLA_LINKINFO) return;
    walk_attributes(value, [&](std::uint16_t inner, std::span<const std::byte> part) {
      if (inner == IFLA_INFO_KIND) {
        const std::string_view text(reinterpret_cast<const char*>(part.data()), part.size());
        interface.kind = text.substr(0, text.find('\0'));
      }
      if (inner == IFLA_INFO_DATA) read_can_data(part, interface);
    });
  });
}

CanInterface inspect_can_interface(const std::string& name) {
  CanInterface interface;
  const UniqueFd socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (socket.get() < 0) throw std::system_error(errno, std::generic_category(), "creating a socket");
  ifreq answer{};
  if (name.size() >= IFNAMSIZ || !ask(socket.get(), SIOCGIFFLAGS, name, answer)) return interface;
  interface.exists = true;
  interface.up = (answer.ifr_flags & IFF_UP) != 0;
  if (ask(socket.get(), SIOCGIFHWADDR, name, answer))
    interface.is_can = answer.ifr_hwaddr.sa_family == ARPHRD_CAN;
  if (ask(socket.get(), SIOCGIFTXQLEN, name, answer)) interface.transmit_queue_frames = answer.ifr_qlen;
  ask_netlink(name, interface);
  return interface;
}

std::vector<std::string> require_can_interface(const std::string& name, const CanInterface& interface,
                                               std::uint32_t bit_rate, int frames_per_cycle) {
  const std::string link_set = "`ip link set " + name + " ";
  if (!interface.exists)
    throw InputError(name + ": there is no such interface: see `ip link`, and plug the adapter in");
  if (!interface.is_can) throw InputError(name + ": is not a CAN interface");
  if (!interface.up)
    throw InputError(name + ": is down: " + link_set + "type can bitrate " + std::to_string(bit_rate) +
                     "`, then " + link_set + "up`");
  const double rate = interface.bit_rate.value_or(0) != 0 ? *interface.bit_rate : bit_rate;
  const double off = rate / bit_rate - 1.0;
  if (std::abs(off) > kRateTolerance)
    throw InputError(name + ": runs at " + std::to_string(*interface.bit_rate) +
                     " bit/s, the configuration says " + std::to_string(bit_rate) + ": set it down, then " +
                     link_set + "type can bitrate " + std::to_string(bit_rate) + "`");
  if (interface.restart_ms && *interface.restart_ms != 0)
    throw InputError(
        name + ": restarts by itself after bus-off, and would then send old orders: set it down, then " +
        link_set + "type can restart-ms 0`");
  // Interfaces without a queue (vcan) hand frames over at once.
  const bool queues = interface.kind != "vcan" && interface.kind != "vxcan";
  if (queues && interface.transmit_queue_frames < frames_per_cycle)
    throw InputError(name + ": its queue holds " + std::to_string(interface.transmit_queue_frames) +
                     " frames, a period needs " + std::to_string(frames_per_cycle) + ": " + link_set +
                     "txqueuelen " + std::to_string(frames_per_cycle) + "`");
  if (off == 0.0) return {};
  return {name + ": runs at " + std::to_string(*interface.bit_rate) + " bit/s, the nearest to " +
          std::to_string(bit_rate) + " that its clock allows"};
}

}  // namespace strainwave
