// SPDX-License-Identifier: BSD-3-Clause
#include "transport/lcm_socket.h"

#include <arpa/inet.h>
#include <linux/filter.h>
#include <linux/if_packet.h>
#include <net/if.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdio>
#include <system_error>

#include "transport/route_interface.h"

namespace strainwave {

namespace {

constexpr std::uint32_t kUdpHeaderBytes = 8;
constexpr std::uint32_t kLoopbackInterface = 1;  // its index in every Linux network namespace

template <typename Value>
void set(int descriptor, int level, int option, const Value& value, const char* what) {
  if (::setsockopt(descriptor, level, option, &value, sizeof value) != 0)
    throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

LcmSocket::LcmSocket(const MulticastAddress& address, std::size_t largest_datagram_bytes, int queue_bytes)
    : descriptor_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)),
      largest_bytes_(largest_datagram_bytes),
      buffers_(kBatch * largest_datagram_bytes),
      sources_(kBatch),
      places_(kBatch),
      headers_(kBatch) {
  if (!descriptor_) throw std::system_error(errno, std::generic_category(), "making a socket");
  join(address, queue_bytes);
  for (std::size_t i = 0; i < kBatch; ++i) {
    places_[i] = {buffers_.data() + i * largest_bytes_, largest_bytes_};
    headers_[i].msg_hdr.msg_name = &sources_[i];
    headers_[i].msg_hdr.msg_iov = &places_[i];
    headers_[i].msg_hdr.msg_iovlen = 1;
  }
}

void LcmSocket::join(const MulticastAddress& address, int queue_bytes) {
  sockaddr_in group{};
  group.sin_family = AF_INET;
  group.sin_port = htons(static_cast<std::uint16_t>(address.port));
  if (::inet_pton(AF_INET, address.group.c_str(), &group.sin_addr) != 1)
    throw std::system_error(EINVAL, std::generic_category(), "reading the group " + address.group);
  filter(address.ttl == 0);
  // Viewers and clients on this machine listen at the same port.
  set(descriptor_.get(), SOL_SOCKET, SO_REUSEADDR, 1, "sharing the port");
  set(descriptor_.get(), IPPROTO_IP, IP_MULTICAST_ALL, 0, "hearing this group alone");
  enlarge_queue(queue_bytes);
  // Bound to the group and not to any address, so that the kernel keeps unicast away.
  if (::bind(descriptor_.get(), static_cast<sockaddr*>(static_cast<void*>(&group)), sizeof group) != 0)
    throw std::system_error(errno, std::generic_category(), "binding to the group");
  group_ = group.sin_addr;
  interface_ = route_interface(group_);
  if (!change_membership(IP_ADD_MEMBERSHIP, interface_))
    throw std::system_error(errno, std::generic_category(), "joining the group");
}

bool LcmSocket::change_membership(int option, int interface) noexcept {
  const ip_mreqn membership{group_, {htonl(INADDR_ANY)}, interface};
  return ::setsockopt(descriptor_.get(), IPPROTO_IP, option, &membership, sizeof membership) == 0;
}

// For the system, an adapter that comes back with the same name and address is a new one. A membership on the old adapter receives
// nothing.
void LcmSocket::follow_route() {
  const auto now = std::chrono::steady_clock::now();
  if (now - looked_ < std::chrono::milliseconds(kLookEvery_ms)) return;
  looked_ = now;
  const int interface = route_interface(group_);
  if (interface == 0 || interface == interface_ || !change_membership(IP_ADD_MEMBERSHIP, interface)) return;
  change_membership(IP_DROP_MEMBERSHIP, interface_);
  interface_ = interface;
  std::array<char, IF_NAMESIZE> name{};
  std::array<char, INET_ADDRSTRLEN> group{};
  ::if_indextoname(static_cast<unsigned int>(interface), name.data());
  ::inet_ntop(AF_INET, &group_, group.data(), group.size());
  std::fprintf(stderr, "the route to %s leads to another or a new adapter, %s: joined the group there anew\n",
               group.data(), name.data());
}

// A process with CAP_NET_ADMIN may exceed the system's usual limit.
void LcmSocket::enlarge_queue(int bytes) {
  if (::setsockopt(descriptor_.get(), SOL_SOCKET, SO_RCVBUFFORCE, &bytes, sizeof bytes) != 0)
    ::setsockopt(descriptor_.get(), SOL_SOCKET, SO_RCVBUF, &bytes, sizeof bytes);
}

int LcmSocket::queue_bytes() const noexcept {
  int doubled = 0;  // Linux doubles the size for its own overhead
  socklen_t size = sizeof doubled;
  ::getsockopt(descriptor_.get(), SOL_SOCKET, SO_RCVBUF, &doubled, &size);
  return doubled / 2;
}

// Called before the socket is bound, so that nothing comes in unfiltered. The filter sees a datagram from its UDP header on.
void LcmSocket::filter(bool this_machine_only) {
  const auto largest = static_cast<std::uint32_t>(largest_bytes_) + kUdpHeaderBytes;
  constexpr auto kAncillary = static_cast<std::uint32_t>(SKF_AD_OFF);
  // A datagram from another machine is neither looped back nor on the loopback interface.
  std::array<sock_filter, 8> program{{BPF_STMT(BPF_LD | BPF_W | BPF_LEN, 0),
                                      BPF_JUMP(BPF_JMP | BPF_JGT | BPF_K, largest, 5, 0),
                                      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kAncillary + SKF_AD_PKTTYPE),
                                      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, PACKET_LOOPBACK, 2, 0),
                                      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, kAncillary + SKF_AD_IFINDEX),
                                      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kLoopbackInterface, 0, 1),
                                      BPF_STMT(BPF_RET | BPF_K, UINT32_MAX), BPF_STMT(BPF_RET | BPF_K, 0)}};
  if (!this_machine_only) program[2] = BPF_STMT(BPF_RET | BPF_K, UINT32_MAX);
  const sock_fprog attached{static_cast<unsigned short>(program.size()), program.data()};
  set(descriptor_.get(), SOL_SOCKET, SO_ATTACH_FILTER, attached, "filtering datagrams");
}

std::size_t LcmSocket::receive(
    const std::function<void(const LcmSource&, std::span<const std::uint8_t>)>& take) {
  for (mmsghdr& header : headers_) header.msg_hdr.msg_namelen = sizeof(sockaddr_in);
  const int received = ::recvmmsg(descriptor_.get(), headers_.data(), kBatch, MSG_DONTWAIT, nullptr);
  if (received <= 0) return 0;
  const auto count = static_cast<std::size_t>(received);
  for (std::size_t i = 0; i < count; ++i) {
    const LcmSource source{ntohl(sources_[i].sin_addr.s_addr), ntohs(sources_[i].sin_port)};
    take(source, std::span(buffers_).subspan(i * largest_bytes_,
                                             std::min<std::size_t>(headers_[i].msg_len, largest_bytes_)));
  }
  return count;
}

}  // namespace strainwave
