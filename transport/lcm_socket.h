// SPDX-License-Identifier: BSD-3-Clause
// The socket that LCM's datagrams come in on. It hears one group on one interface: the one that the route to the group
// names, which is also the one that LCM sends on. Datagrams to this machine's own address never reach it, and what is longer than
// any message of ours the kernel drops before it takes room in the socket's queue. Memory is taken when it is made. When the adapter
// was taken away and came back, or the route moved, it follows within a second and says so on standard error.
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
  /// Of the system's queue before it, for some hundred of the largest messages.
  static constexpr int kQueueBytes = 1 << 20;

  /// Joins the group. With a ttl of 0 nothing from another machine is heard, even where the route leads to a real
  /// interface. `queue_bytes`: room for what comes between two calls; the system may give less, unless this
  /// process administers the network. Throws std::system_error.
  LcmSocket(const MulticastAddress& address, std::size_t largest_datagram_bytes,
            int queue_bytes = kQueueBytes);

  int descriptor() const noexcept { return descriptor_.get(); }
  /// What the system gave of the queue that was asked for.
  int queue_bytes() const noexcept;
  /// Call it so often at the least, also when nothing comes: looks where the route leads, and follows it.
  /// It makes a socket, which the gateway may not.
  void follow_route();
  static constexpr int kLookEvery_ms = 500;
  /// Hands at most kBatch datagrams that are here to `take`. Returns how many there were; never waits.
  std::size_t receive(const std::function<void(const LcmSource&, std::span<const std::uint8_t>)>& take);

 private:
  void join(const MulticastAddress& address, int queue_bytes);
  bool change_membership(int option, int interface) noexcept;
  void filter(bool this_machine_only);
  void enlarge_queue(int bytes);

  UniqueFd descriptor_;
  in_addr group_{};
  int interface_ = 0;  ///< index of the one that it hears the group on; 0: the system did not tell
  std::chrono::steady_clock::time_point looked_ = std::chrono::steady_clock::now();
  std::size_t largest_bytes_;
  std::vector<std::uint8_t> buffers_;
  std::vector<sockaddr_in> sources_;
  std::vector<iovec> places_;
  std::vector<mmsghdr> headers_;
};

}  // namespace strainwave
