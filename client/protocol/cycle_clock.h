// SPDX-License-Identifier: BSD-3-Clause
// Estimates the daemon's current cycle from received states. The state with the shortest travel time gives the estimate. Not real-time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>

#include "client/protocol/clock.h"

namespace strainwave {

class CycleClock {
 public:
  static constexpr std::size_t kStates = 64;

  /// Forgets all states, after a restart of the daemon.
  void restart() noexcept { heard_.clear(); }

  /// Notes that a state of `cycle` was received at `received`.
  void take(std::int64_t cycle, Instant received) {
    if (heard_.size() == kStates) heard_.pop_front();
    heard_.push_back({cycle, received});
  }

  bool empty() const noexcept { return heard_.empty(); }

  /// The cycle at `time`, as a real number. At least one state must have been received.
  ///   c(t) = max over the latest states of cycle_i + (t - received_i) / period_s
  double cycle_at(Instant time, double period_s) const noexcept {
    double latest = -std::numeric_limits<double>::infinity();
    for (const Heard& state : heard_)
      latest = std::max(latest,
                        static_cast<double>(state.cycle) + seconds_between(state.received, time) / period_s);
    return latest;
  }

 private:
  struct Heard {
    std::int64_t cycle;
    Instant received;
  };
  std::deque<Heard> heard_;
};

}  // namespace strainwave
