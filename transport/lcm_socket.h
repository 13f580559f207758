// SPDX-License-Identifier: BSD-3-Clause
// The socket that receives LCM's datagrams. It hears one group on one interface: that of the route to the group, on which LCM also
// sends. Datagrams to this machine's own address never reach it. The kernel drops datagrams that are longer than any message of ours
// before they take room in the queue. The constructor allocates all memory. When the adapter was removed and came back, or the route
// moved, the socket follows within a second and reports it on standard error.
#pragma once

#include <netinet/in.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/unique_fd.h"
#include "lcmtypes/multicast_check.h"
#include "transport/lcm_reassembly.h"

namespace strainwave {

class LcmSocket {
 public:
  static constexpr std::size_t kBatch = 32;
  /// Size of the socket's queue in the system, enough for about a hundred of the largest messages.
  static constexpr int kQueueBytes = 1 << 20;

  /// Joins the group. With a ttl of 0 the socket hears no other machine, even if the route leads to a real interface.
  /// `queue_bytes`: room for the datagrams between two calls. The system may give less to a process without
  /// CAP_NET_ADMIN. Throws std::system_error.
  LcmSocket(const MulticastAddress& address, std::size_t largest_datagram_bytes,
            int queue_bytes = kQueueBytes);

  int descriptor() const noexcept { return descriptor_.get(); }
  /// Size of the queue that the system granted.
  int queue_bytes() const noexcept;
  /// Looks where the route leads, and follows it. Call it at least every kLookEvery_ms, even if no datagram arrives.
  /// It makes a socket, which the confined gateway may not do.
  void follow_route();
  static constexpr int kLookEvery_ms = 500;
  /// Hands at most kBatch datagrams of the queue to `take`. Returns their number; never waits.
  std::size_t receive(const std::function<void(const LcmSource&, std::span<const std::uint8_t>)>& take);

 private:
  void join(const MulticastAddress& address, int queue_bytes);
  bool change_membership(int option, int interface) noexcept;
  void filter(bool this_machine_only);
  void enlarge_queue(int bytes);

  UniqueFd descriptor_;
  in_addr group_{};
  int interface_ = 0;  ///< index of the interface of the group; 0: unknown
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
  std::size_t largest_bytes_;
  std::vector<std::uint8_t> buffers_;
  std::vector<sockaddr_in> sources_;
  std::vector<iovec> places_;
  std::vector<mmsghdr> headers_;
};

}  // namespace strainwave
