// SPDX-License-Identifier: BSD-3-Clause
// An attacker on the path between client and daemon: the only link between two LCM networks on two ports.
#pragma once

#include <poll.h>

#include <array>
#include <atomic>
#include <lcm/lcm-cpp.hpp>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/support/test_client.h"

namespace strainwave::testing {

/// The network of the daemon.
inline constexpr const char* kInsideUrl = "udpm://239.255.76.67:7668?ttl=0";
class Relay {
 public:
  Relay() : inside_(kInsideUrl), outside_(kTestUrl) {
    inside_.subscribe("SW\\..*(STATE|ACK|TIMING)", &Relay::outwards, this)->setQueueCapacity(1000);
    outside_.subscribe("SW\\..*(SETPOINT|PATH|COMMAND|TABLE|INJECT)", &Relay::inwards, this);
    thread_ = std::thread([this] { run(); });
  }
  ~Relay() {
    stop_ = true;
    thread_.join();
  }
  Relay(const Relay&) = delete;
  Relay& operator=(const Relay&) = delete;

  void keep_back(bool whether) { keeps_ = whether; }
  std::size_t kept() {
    const std::lock_guard lock(mutex_);
    return kept_.size();
  }
  /// Delivers the withheld messages in their order.
  void deliver() {
    const std::lock_guard lock(mutex_);
    for (const Kept& order : kept_)
      inside_.publish(order.channel, order.bytes.data(), static_cast<unsigned int>(order.bytes.size()));
    kept_.clear();
  }

 private:
  struct Kept {
    std::string channel;
    std::vector<std::uint8_t> bytes;
  };
  void run() {
    while (!stop_) {
      std::array<pollfd, 2> waiting{{{inside_.getFileno(), POLLIN, 0}, {outside_.getFileno(), POLLIN, 0}}};
      ::poll(waiting.data(), waiting.size(), 20);
      if ((waiting[0].revents & POLLIN) != 0) inside_.handle();
      if ((waiting[1].revents & POLLIN) != 0) outside_.handle();
    }
  }
  void outwards(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    outside_.publish(channel, buffer->data, buffer->data_size);
  }
  void inwards(const lcm::ReceiveBuffer* buffer, const std::string& channel) {
    const std::lock_guard lock(mutex_);
    const auto* bytes = static_cast<const std::uint8_t*>(buffer->data);
    if (keeps_)
      kept_.push_back({channel, {bytes, bytes + buffer->data_size}});
    else
      inside_.publish(channel, buffer->data, buffer->data_size);
  }

  lcm::LCM inside_;
  lcm::LCM outside_;
  std::mutex mutex_;
  std::vector<Kept> kept_;
  std::atomic<bool> keeps_{false};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace strainwave::testing
