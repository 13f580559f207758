// SPDX-License-Identifier: BSD-3-Clause
// Whether what the gateway publishes comes back to it. A network that does not bring it brings no order either: the adapter or the route
// that it joined the group on has gone. Pure: time is an argument. Not real-time.
#pragma once

#include <cstdint>

namespace strainwave {

class OwnEcho {
 public:
  /// Within one PC a datagram comes back in well under a millisecond; states go out ten times a second at the least.
  static constexpr std::int64_t kPatience_ns = 600'000'000;

  /// A state was sent.
  void published(std::int64_t now_ns) noexcept {
    if (waiting_since_ns_ == 0) waiting_since_ns_ = now_ns;
  }
  /// One came back, or may have: more waited than was read.
  void heard() noexcept { waiting_since_ns_ = 0; }
  /// Ask after all that came was read.
  bool missing(std::int64_t now_ns) const noexcept {
    return waiting_since_ns_ != 0 && now_ns - waiting_since_ns_ > kPatience_ns;
  }

 private:
  std::int64_t waiting_since_ns_ = 0;  ///< 0: for none
};

}  // namespace strainwave
