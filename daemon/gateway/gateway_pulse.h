// SPDX-License-Identifier: BSD-3-Clause
// Whether the gateway hangs, from the count of its turns. Pure: time is an argument. Not real-time.
#pragma once

#include <cstdint>

#include "base/durations.h"

namespace strainwave {

class GatewayPulse {
 public:
  /// One that went round and then does nothing for this long hangs, however young it is.
  static constexpr std::int64_t kSilence_ns = 2'000'000'000;
  /// Until its first turn a gateway reads nothing that came in, so that no message from outside can make it hang. Before
  /// that only this machine makes it slow, and a restart would make it slower. The unit strainwave-gateway@.service has the same time.
  static constexpr std::int64_t kStart_ns = 5'000'000'000;

  /// Whether the gateway that was started at `started_ns` hangs at `now_ns`. `turns`: of it and all before it. Ask every turn of the
  /// core's, also while there is none; says so again when it goes on hanging.
  bool hangs(std::int64_t started_ns, std::uint64_t turns, std::int64_t now_ns) noexcept {
    if (started_ns != started_ns_) {
      started_ns_ = moved_ns_ = started_ns;
      turned_ = false;
    }
    if (turns != turns_) {
      turns_ = turns;
      moved_ns_ = now_ns;
      turned_ = true;
    }
    if (now_ns - moved_ns_ < patience_ns()) return false;
    moved_ns_ = now_ns;
    return true;
  }
  /// How long it may do nothing, s.
  double patience_s() const noexcept { return seconds(patience_ns()); }

 private:
  std::int64_t patience_ns() const noexcept { return turned_ ? kSilence_ns : kStart_ns; }

  std::int64_t started_ns_ = -1;
  std::int64_t moved_ns_ = 0;
  std::uint64_t turns_ = 0;
  bool turned_ = false;
};

}  // namespace strainwave
