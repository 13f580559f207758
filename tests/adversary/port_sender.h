// SPDX-License-Identifier: BSD-3-Clause
// Sends datagrams to the tests' LCM group from its own port, so that the gateway sees a separate source.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "base/unique_fd.h"
#include "tests/support/lcm_datagrams.h"

namespace strainwave::testing {

class PortSender {
 public:
  PortSender() : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    group_.sin_family = AF_INET;
    group_.sin_port = htons(7667);
    ::inet_pton(AF_INET, "239.255.76.67", &group_.sin_addr);
  }

  /// Errors are ignored: as usual with UDP, a datagram that the system does not accept is lost.
  void send(const Bytes& datagram) const {
    ::sendto(socket_.get(), datagram.data(), datagram.size(), 0,
             static_cast<const sockaddr*>(static_cast<const void*>(&group_)), sizeof group_);
  }

 private:
  UniqueFd socket_;
  sockaddr_in group_{};
};

}  // namespace strainwave::testing
