// SPDX-License-Identifier: BSD-3-Clause
// Receives whole messages of every channel of LCM's network, with Strainwave's own receiver (transport/). It never sends. Not real-time.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "transport/lcm_reassembly.h"
#include "transport/lcm_socket.h"

namespace strainwave {

class LcmListener {
 public:
  using Take = std::function<void(const LcmSource& from, std::string_view channel,
                                  std::span<const std::uint8_t> bytes)>;

  /// Joins the network of `lcm_url`, which must have passed find_udpm_defect(). Throws std::system_error when the system refuses.
  explicit LcmListener(const std::string& lcm_url);

  /// Becomes readable when there is something to receive.
  int descriptor() const noexcept { return socket_.descriptor(); }

  /// Passes the waiting messages to `take`: some hundred datagrams at most, so that other work does not wait long. Never waits.
  void receive(const Take& take);

  const LcmReassembly::Counts& counts() const noexcept { return reassembly_.counts(); }

 private:
  LcmSocket socket_;
  LcmReassembly reassembly_;
};

}  // namespace strainwave
