// SPDX-License-Identifier: BSD-3-Clause
// Detects a gateway that hangs, from the count of its turns. Pure: time is an argument. Not real-time.
#pragma once

#include <cstdint>

#include "base/durations.h"

namespace strainwave {

class GatewayPulse {
 public:
  /// A gateway that made a turn and then none for this long hangs, however recently it started.
  static constexpr std::int64_t kSilence_ns = 2'000'000'000;
  /// Limit before the first turn. A gateway reads no message before it, so only a slow machine can delay it, and a restart would
  /// delay it more. The unit strainwave-gateway@.service has the same limit.
  static constexpr std::int64_t kStart_ns = 5'000'000'000;

  /// Whether the gateway that was started at `started_ns` hangs at `now_ns`. `turns`: count of its turns and those of all earlier
  /// gateways. Call it in every turn of the core, even without a gateway. While it hangs, returns true once per limit.
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
  /// The present limit, s.
  double patience_s() const noexcept { return seconds(patience_ns()); }

 private:
  std::int64_t patience_ns() const noexcept { return turned_ ? kSilence_ns : kStart_ns; }

  std::int64_t started_ns_ = -1;
  std::int64_t moved_ns_ = 0;
  std::uint64_t turns_ = 0;
  bool turned_ = false;
};

}  // namespace strainwave
