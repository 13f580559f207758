// SPDX-License-Identifier: BSD-3-Clause
// Detects that the gateway's own states no longer come back. Then no orders arrive either: the adapter or route on which it joined
// the multicast group has gone. Pure: time is an argument. Not real-time.
#pragma once

#include <cstdint>

namespace strainwave {

class OwnEcho {
 public:
  /// A datagram comes back within a PC in well under a millisecond. States are sent at least ten times a second.
  static constexpr std::int64_t kPatience_ns = 600'000'000;

  /// A state was sent.
  void published(std::int64_t now_ns) noexcept {
    if (waiting_since_ns_ == 0) waiting_since_ns_ = now_ns;
  }
  /// A state came back, or may wait among datagrams that were not read yet.
  void heard() noexcept { waiting_since_ns_ = 0; }
  /// Call it after all waiting datagrams have been read.
  bool missing(std::int64_t now_ns) const noexcept {
    return waiting_since_ns_ != 0 && now_ns - waiting_since_ns_ > kPatience_ns;
  }

 private:
  std::int64_t waiting_since_ns_ = 0;  ///< 0: not waiting
};

}  // namespace strainwave
