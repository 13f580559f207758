// SPDX-License-Identifier: BSD-3-Clause
// Reads LCM's socket into bounded memory in a thread of its own. Datagrams that arrive while the owner is busy are lost only when this
// memory is full. One other thread takes them. The system's queue of a socket is much smaller by default: 208 KB on Debian, 26 ms of
// 64 joints. Not real-time.
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

  /// Reads `socket`, which must outlive this object; no other thread may read it. `room_bytes`: room for waiting datagrams. Twice as much
  /// is reserved, since a second buffer holds those being taken; memory is used as it fills. Throws std::system_error.
  LcmReadAhead(LcmSocket& socket, std::size_t room_bytes);
  ~LcmReadAhead();
  LcmReadAhead(const LcmReadAhead&) = delete;
  LcmReadAhead& operator=(const LcmReadAhead&) = delete;

  /// Becomes readable when datagrams wait.
  int descriptor() const noexcept { return filled_.get(); }
  /// Hands at most LcmSocket::kBatch datagrams to `take`, each with the time when it was read (us since the epoch). Returns their number;
  /// never waits for a datagram.
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
  std::mutex mutex_;                   ///< protects filling_
  std::vector<std::uint8_t> filling_;  ///< heads and datagrams, one after the other
  std::vector<std::uint8_t> taking_;   ///< the same, for the taking thread
  std::size_t taken_bytes_ = 0;
  std::atomic<std::uint64_t> dropped_{0};
  std::jthread thread_;  ///< the last member: it uses the others
};

}  // namespace strainwave
