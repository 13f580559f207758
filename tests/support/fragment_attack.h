// SPDX-License-Identifier: BSD-3-Clause
// An attacker that repeatedly sends the fragments which crash receivers with LCM's library (lcm_datagrams.h).
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "base/unique_fd.h"
#include "lcmtypes/multicast_check.h"
#include "tests/support/lcm_datagrams.h"

namespace strainwave::testing {

class FragmentAttack {
 public:
  /// Sends to `channels` every millisecond until it goes out of scope. LCM's library looks only at fragments
  /// of channels with a subscriber.
  FragmentAttack(const std::string& lcm_url, std::vector<std::string> channels)
      : address_(*parse_udpm_url(lcm_url)), channels_(std::move(channels)), thread_([this] { run(); }) {}
  ~FragmentAttack() {
    stop_ = true;
    thread_.join();
  }
  FragmentAttack(const FragmentAttack&) = delete;
  FragmentAttack& operator=(const FragmentAttack&) = delete;

  /// Number of times that every channel was sent its fragments.
  std::uint32_t rounds() const noexcept { return rounds_; }

 private:
  void run() {
    const UniqueFd sender(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
    sockaddr_in group{};
    group.sin_family = AF_INET;
    group.sin_port = htons(static_cast<std::uint16_t>(address_.port));
    ::inet_pton(AF_INET, address_.group.c_str(), &group.sin_addr);
    std::uint32_t sequence = 0;
    for (; !stop_; ++rounds_) {
      for (const std::string& channel : channels_)
        for (const Bytes& datagram : crashing_fragments(channel, ++sequence))
          ::sendto(sender.get(), datagram.data(), datagram.size(), 0,
                   static_cast<const sockaddr*>(static_cast<const void*>(&group)), sizeof group);
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  MulticastAddress address_;
  std::vector<std::string> channels_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint32_t> rounds_{0};
  std::thread thread_;
};

}  // namespace strainwave::testing
