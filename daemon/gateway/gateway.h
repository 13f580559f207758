// SPDX-License-Identifier: BSD-3-Clause
// The gateway: the only process of the daemon with a network socket. It passes raw bytes from LCM's network to the core and publishes what
// the core wrote. It decides nothing and knows no secret, so an attacker gains little by it. Its own receiver reads
// the datagrams; LCM's library only sends. Stops go first, and sources take turns. Not real-time.
#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <memory>
#include <span>
#include <string>

#include "daemon/gateway/order_queue.h"
#include "daemon/gateway/own_echo.h"
#include "daemon/gateway/shared_memory.h"
#include "transport/lcm_reassembly.h"
#include "transport/lcm_socket.h"

namespace strainwave {

class Gateway {
 public:
  /// Opens and binds everything, but reads no datagram before the first turn(). `wake_fd`: non-blocking end of the pipe
  /// that wakes the core when a message waits.
  Gateway(const OutboundMemory& outbound, InboundMemory& inbound, int wake_fd);

  /// Whether LCM could be set up; if not, why and what to do.
  bool good() const noexcept { return problem_.empty(); }
  const std::string& problem() const noexcept { return problem_; }

  /// Waits at most `wait_ms` for datagrams, takes a bounded number of them, then publishes every message and a bounded number of
  /// states. Does not wait while more states are left. False: its own states do not come back, so no orders arrive either, and a new
  /// gateway must join the multicast group.
  bool turn(int wait_ms);

 private:
  void open_network();
  void receive();
  void sort(const LcmSource& from, std::span<const std::uint8_t> datagram);
  void note_state(std::span<const std::uint8_t> bytes);
  void hand_over();
  /// Returns whether no state is left.
  bool publish_states();
  void publish(StateRecord& record);
  void publish_messages();

  const OutboundMemory& outbound_;
  InboundMemory& inbound_;
  int wake_fd_;
  lcm::LCM lcm_;
  std::unique_ptr<LcmSocket> socket_;
  LcmReassembly reassembly_;
  OrderQueue stops_;
  OrderQueue orders_;
  std::string problem_;
  std::uint64_t state_cursor_;
  std::uint64_t message_cursor_;
  std::uint64_t states_dropped_ = 0;
  OwnEcho echo_;
  bool behind_ = false;  ///< states were left to the next turn
};

}  // namespace strainwave
