// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/can_nodes/can_port.h"

#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <system_error>

namespace strainwave::can_nodes {

namespace {

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

CanPort::CanPort(const std::string& interface, const std::vector<AcceptanceFilter>& filters)
    : descriptor_(::socket(PF_CAN, SOCK_RAW | SOCK_NONBLOCK | SOCK_CLOEXEC, CAN_RAW)) {
  if (!descriptor_) fail("this kernel gives no CAN socket (is the module can-raw there?)");
  std::vector<can_filter> accepted;
  for (const AcceptanceFilter& filter : filters) accepted.push_back({filter.id, filter.mask | CAN_EFF_FLAG});
  if (::setsockopt(descriptor_.get(), SOL_CAN_RAW, CAN_RAW_FILTER, accepted.data(),
                   static_cast<socklen_t>(accepted.size() * sizeof(can_filter))) != 0)
    fail("setting CAN filters");
  const unsigned index = ::if_nametoindex(interface.c_str());
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  // The kernel's interface for socket addresses.
  const auto* generic = std::bit_cast<const sockaddr*>(&address);
  if (index == 0 || ::bind(descriptor_.get(), generic, sizeof address) != 0)
    fail("CAN interface '" + interface + "'");
}

std::optional<Frame> CanPort::receive() {
  can_frame raw{};
  while (::read(descriptor_.get(), &raw, sizeof raw) == static_cast<ssize_t>(sizeof raw)) {
    if ((raw.can_id & (CAN_EFF_FLAG | CAN_ERR_FLAG)) != 0) continue;
    Frame frame(raw.can_id & CAN_SFF_MASK, {raw.data, std::min<std::size_t>(raw.len, CAN_MAX_DLEN)});
    frame.remote = (raw.can_id & CAN_RTR_FLAG) != 0;
    return frame;
  }
  return std::nullopt;
}

bool CanPort::send(const Frame& frame) {
  can_frame raw{};
  raw.can_id = frame.id | (frame.remote ? CAN_RTR_FLAG : 0U);
  raw.len = frame.length;
  std::copy_n(frame.data.begin(), frame.length, raw.data);
  return ::write(descriptor_.get(), &raw, sizeof raw) == static_cast<ssize_t>(sizeof raw);
}

}  // namespace strainwave::can_nodes
