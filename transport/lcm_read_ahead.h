// SPDX-License-Identifier: BSD-3-Clause
// Empties LCM's socket in a thread of its own into bounded memory: what comes while its owner is busy, or does not get a processor, is
// lost only when that is full. One other thread takes from it. The system's own queue before a socket is much smaller by default:
// 208 KB on Debian, 26 ms of 64 joints. Not real-time.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <span>
#include <thread>
#include <vector>

#include "base/unique_fd.h"
#include "transport/lcm_socket.h"

namespace strainwave {

class LcmReadAhead {
 public:
  using Take =
      std::function<void(const LcmSource& from, std::int64_t received_us, std::span<const std::uint8_t>)>;

  /// Reads `socket`, which must outlive it and which no other thread reads meanwhile. `room_bytes`: what may wait while as much is being
  /// taken; memory is used as it fills. Throws std::system_error.
  LcmReadAhead(LcmSocket& socket, std::size_t room_bytes);
  ~LcmReadAhead();
  LcmReadAhead(const LcmReadAhead&) = delete;
  LcmReadAhead& operator=(const LcmReadAhead&) = delete;

  /// Becomes readable when something waits.
  int descriptor() const noexcept { return filled_.get(); }
  /// Hands at most LcmSocket::kBatch datagrams to `take`, with when they were read (us since the epoch). Returns how many there were;
  /// never waits.
  std::size_t receive(const Take& take);
  /// Datagrams that found no room.
  std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  struct Head {
    LcmSource from;
    std::uint32_t bytes = 0;
    std::int64_t received_us = 0;
  };
  void read(const std::stop_token& stop);
  void put(const Head& head, std::span<const std::uint8_t> datagram);
  void fetch();

  LcmSocket& socket_;
  std::size_t room_bytes_;
  UniqueFd filled_;
  UniqueFd stop_;
  std::mutex mutex_;                   ///< of filling_
  std::vector<std::uint8_t> filling_;  ///< heads and datagrams, one after the other
  std::vector<std::uint8_t> taking_;   ///< likewise, the taker's
  std::size_t taken_bytes_ = 0;
  std::atomic<std::uint64_t> dropped_{0};
  std::jthread thread_;  ///< the last member: it uses the others
};

}  // namespace strainwave
