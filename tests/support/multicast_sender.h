// SPDX-License-Identifier: BSD-3-Clause
// Sends plain datagrams to LCM's group on this machine from one socket.
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cstdint>

#include "base/unique_fd.h"
#include "tests/support/lcm_datagrams.h"

namespace strainwave::testing {

class MulticastSender {
 public:
  explicit MulticastSender(std::uint16_t port) {
    address_.sin_family = AF_INET;
    address_.sin_port = htons(port);
    ::inet_pton(AF_INET, "239.255.76.67", &address_.sin_addr);
  }
  void send(const Bytes& datagram) const {
    EXPECT_EQ(::sendto(socket_.get(), datagram.data(), datagram.size(), 0,
                       static_cast<const sockaddr*>(static_cast<const void*>(&address_)), sizeof address_),
              static_cast<ssize_t>(datagram.size()));
  }

 private:
  sockaddr_in address_{};
  UniqueFd socket_{::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)};
};

}  // namespace strainwave::testing
