// SPDX-License-Identifier: BSD-3-Clause
// Sends messages to the service manager (systemd): ready once the loop meets its timing, alive while the loop
// runs, and the modes of the joints as a status line. Without a service manager it sends nothing. Not
// real-time. Source: sd_notify(3).
#pragma once

#include <cstdint>
#include <string>

namespace strainwave {

/// The loop meets its timing once `cycles_needed` cycles in a row began without a skipped period.
class TimingProof {
 public:
  explicit TimingProof(std::int64_t cycles_needed) : cycles_needed_(cycles_needed) {}

  /// Takes totals since the loop's start, as in LoopTotals. Returns true from the first proof on.
  bool update(std::int64_t cycles, std::int64_t overruns) noexcept {
    if (overruns != overruns_) {
      overruns_ = overruns;
      since_cycle_ = cycles;
    }
    proven_ = proven_ || cycles - since_cycle_ >= cycles_needed_;
    return proven_;
  }

 private:
  std::int64_t cycles_needed_;
  std::int64_t since_cycle_ = 0;
  std::int64_t overruns_ = 0;
  bool proven_ = false;
};

class ServiceNotifier {
 public:
  /// Reads the watchdog's time from the environment ($WATCHDOG_USEC).
  ServiceNotifier();

  /// Call it once per turn of the supervisor. Sends "ready" when the timing is proven. Sends "alive" several times
  /// within the watchdog's time, but only if `cycles` has risen in between.
  void update(std::int64_t cycles, std::int64_t overruns, std::int64_t now_ns);
  bool ready() const noexcept { return ready_; }
  /// The line that `systemctl status` shows; sent when it has changed.
  void show(const std::string& status);
  void stopping();

 private:
  TimingProof timing_;
  std::int64_t alive_every_ns_;
  std::int64_t alive_due_ns_ = 0;
  std::int64_t alive_cycles_ = -1;
  bool ready_ = false;
  std::string shown_;
};

}  // namespace strainwave
