// The gateway: the only process of the daemon with a network socket. It passes raw bytes from LCM to the core and
// publishes what the core wrote; it judges nothing and knows no secret, so that losing it loses nothing. Not real-time.
#pragma once

#include <cstdint>
#include <lcm/lcm-cpp.hpp>
#include <string>

#include "daemon/gateway/shared_memory.h"

namespace strainwave {

class Gateway {
 public:
  /// `wake_fd`: an eventfd that tells the core that a message waits.
  Gateway(const OutboundMemory& outbound, InboundMemory& inbound, int wake_fd);

  /// Whether LCM could be set up; if not, why and what to do.
  bool good() const noexcept { return problem_.empty(); }
  const std::string& problem() const noexcept { return problem_; }

  /// Receives for at most `wait_ms`, then publishes what is new.
  void turn(int wait_ms);

 private:
  void on_order(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void on_state(const lcm::ReceiveBuffer* buffer, const std::string& channel);
  void receive(int wait_ms);
  void publish_states();
  void publish_messages();

  const OutboundMemory& outbound_;
  InboundMemory& inbound_;
  int wake_fd_;
  lcm::LCM lcm_;
  std::string problem_;
  std::uint64_t state_cursor_;
  std::uint64_t message_cursor_;
  std::uint64_t states_dropped_ = 0;
  std::uint64_t messages_dropped_ = 0;
};

}  // namespace strainwave
