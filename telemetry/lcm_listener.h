// SPDX-License-Identifier: BSD-3-Clause
// LCM's network, heard and never spoken to: whole messages of every channel, by our own receiver (transport/). Not real-time.
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

  /// Hands what is here to `take`: some hundred datagrams at most, so that nothing else waits long. Never waits.
  void receive(const Take& take);

  const LcmReassembly::Counts& counts() const noexcept { return reassembly_.counts(); }

 private:
  LcmSocket socket_;
  LcmReassembly reassembly_;
};

}  // namespace strainwave
