// SPDX-License-Identifier: BSD-3-Clause
// How old a position is that a drive samples with each SYNC and sends later: from the time stamps that the kernel gives SYNC
// and TPDO. Real-time safe.
//
// A TPDO does not say which SYNC it belongs to. Its delay is measured at start-up, at the loop's own rate. From there on two
// things are followed:
//
//   its place in the period   after SYNCs without a TPDO, one that comes at another place in the period than start-up measured is late
//                             by those periods; two with one SYNC catch up by a period. One that stays at another place for no
//                             such reason is displaced: by how many periods it is late cannot be known
//   the first position        of the first SYNC, before which the bus was silent: what it is late by stays, until TPDO2 comes earlier
//   the place of TPDO2        which the drive sends with every nth SYNC that it counts: lateness of whole periods, which leaves
//                             TPDO1 at its place as if some had been lost, moves it among the SYNCs
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace strainwave {

class SampleAge {
 public:
  /// `slow_every`: the SYNCs from one TPDO2 to the next; 1: nothing can be seen from it.
  SampleAge(std::int64_t period_ns, int slow_every) noexcept
      : period_ns_(period_ns), slow_every_(slow_every) {}

  /// `delay_ns` >= 0: from SYNC to TPDO, as measured.
  void restart(std::int64_t delay_ns) noexcept {
    usual_lag_ = lag_ = static_cast<int>(delay_ns / period_ns_);
    syncs_ = samples_at_place_ = displaced_samples_ = 0;
    delay_ns_ = delay_ns;
    usual_phase_ns_ = moved_phase_ns_ = within_a_period(delay_ns);
    started_ = false;
    // Later restarts happen while SYNCs are sent, so the first one of them that the drive answers is not known.
    from_silence_ = sync_count_ == 0;
    slow_ = {};
  }
  /// Kernel's time; 0: unknown, then nothing is said of the age.
  void sync(std::int64_t time_ns) noexcept {
    sync_ns_ = time_ns;
    if (first_sync_ns_ == 0) first_sync_ns_ = time_ns;
    ++syncs_;
    ++sync_count_;
  }
  void sample(std::int64_t time_ns) noexcept {
    if (sync_ns_ == 0 || time_ns == 0) return;
    // Within a period: an adapter may tell of our SYNC later than of its answer, so which SYNC was the last one shows nothing.
    const std::int64_t phase_ns = within_a_period(time_ns - sync_ns_);
    const bool at_its_place = near(phase_ns, usual_phase_ns_);
    if (!started_ && from_silence_) slow_.late_from_start = periods_late_at_start(time_ns, at_its_place);
    if (started_ && syncs_ != 1) moved_phase_ns_ = phase_ns;
    displaced_samples_ =
        at_its_place || near(phase_ns, moved_phase_ns_) ? 0 : std::min(displaced_samples_ + 1, kSettled);
    if (started_ && syncs_ == 0 && lag_ > 0) --lag_;
    if (started_ && syncs_ > 1 && !at_its_place) lag_ += syncs_ - 1;
    samples_at_place_ = at_its_place ? samples_at_place_ + 1 : 0;
    // One that is back where it was for so long has caught up unseen.
    if (samples_at_place_ >= kSettled) lag_ = usual_lag_;
    started_ = true;
    syncs_ = 0;
    delay_ns_ = lag_periods() * period_ns_ + phase_ns;
  }
  /// TPDO2 has come.
  void slow_sample(std::int64_t time_ns) noexcept {
    if (sync_ns_ == 0 || time_ns == 0 || slow_every_ < 2) return;
    const std::int64_t since_ns = time_ns - sync_ns_;
    const std::int64_t came_with = sync_count_ + (since_ns - within_a_period(since_ns)) / period_ns_;
    if (!slow_.started) slow_.usual = came_with;
    slow_.started = true;
    slow_.see(around_zero(came_with - slow_.usual));
  }
  /// Of the newest sample, from its SYNC until it came.
  std::int64_t delay_ns() const noexcept { return delay_ns_; }
  /// It has been coming at another place in the period than start-up measured, and nothing tells why.
  bool displaced() const noexcept { return displaced_samples_ >= kSettled; }
  /// How many SYNCs later than the newest one before it came it was sampled.
  int lag_periods() const noexcept { return std::max(lag_, usual_lag_ + slow_.late_from_start + slow_.late); }
  /// Those beyond what was measured at start-up, and beyond the last `left_out` periods, in which no SYNC was sent: what comes then is
  /// of the last one before them, or of as many more before it as is usual.
  int late_periods(int left_out = 0) const noexcept {
    return lag_periods() - usual_lag_ + std::max(0, left_out - usual_lag_);
  }

 private:
  /// Of a period: what a TPDO's place may jitter by, on adapters that tell of frames promptly.
  static constexpr std::int64_t kPlaceShare = 5;
  static constexpr int kSettled = 50;
  /// TPDO2s in a row: a single one may wait behind other frames.
  static constexpr int kAgreeing = 3;

  /// Where TPDO2 comes among the SYNCs.
  struct SlowPlace {
    void see(std::int64_t off) noexcept {
      const bool agrees = in_a_row > 0 && (off > 0) == (least > 0) && off != 0;
      in_a_row = off == 0 ? 0 : agrees ? in_a_row + 1 : 1;
      if (!agrees || std::abs(off) < std::abs(least)) least = off;
      if (off == 0) late = 0;
      if (in_a_row < kAgreeing) return;
      // No drive answers before it is asked: what is early has caught up, or tells of a SYNC that was not seen here.
      if (least < 0) {
        usual += least;
        late_from_start = std::max(late_from_start + static_cast<int>(least), 0);
      }
      late = least > 0 ? static_cast<int>(least) : 0;
      if (least < 0) in_a_row = 0;
    }
    std::int64_t usual = 0;   ///< a SYNC with which it came when it was on time
    std::int64_t least = 0;   ///< of those in a row
    int in_a_row = 0;         ///< so many were off to the same side
    int late = 0;             ///< periods, since `usual` was seen
    int late_from_start = 0;  ///< periods that `usual` itself is late
    bool started = false;
  };

  std::int64_t within_a_period(std::int64_t time_ns) const noexcept {
    const std::int64_t rest_ns = time_ns % period_ns_;
    return rest_ns < 0 ? rest_ns + period_ns_ : rest_ns;
  }
  bool near(std::int64_t phase_ns, std::int64_t other_ns) const noexcept {
    const std::int64_t off_ns = within_a_period(phase_ns - other_ns);
    return std::min(off_ns, period_ns_ - off_ns) <= period_ns_ / kPlaceShare;
  }
  /// Of the first position, beyond the usual lag.
  int periods_late_at_start(std::int64_t time_ns, bool at_its_place) const noexcept {
    const std::int64_t since_ns =
        time_ns - first_sync_ns_ + (at_its_place ? period_ns_ / 2 - usual_phase_ns_ : 0);
    return static_cast<int>(std::max<std::int64_t>(since_ns / period_ns_ - usual_lag_, 0));
  }
  /// The same place among the SYNCs between two TPDO2s, from -slow_every / 2 to slow_every / 2.
  std::int64_t around_zero(std::int64_t syncs) const noexcept {
    const std::int64_t rest = ((syncs % slow_every_) + slow_every_) % slow_every_;
    return rest > slow_every_ / 2 ? rest - slow_every_ : rest;
  }

  std::int64_t period_ns_;
  std::int64_t slow_every_;
  std::int64_t usual_phase_ns_ = 0;  ///< as start-up measured it
  std::int64_t moved_phase_ns_ = 0;  ///< after the last gap or catching up
  int usual_lag_ = 0;
  int lag_ = 0;
  std::int64_t sync_ns_ = 0;
  std::int64_t first_sync_ns_ = 0;
  std::int64_t sync_count_ = 0;
  std::int64_t delay_ns_ = 0;
  int syncs_ = 0;  ///< since the last sample
  int samples_at_place_ = 0;
  int displaced_samples_ = 0;
  SlowPlace slow_;
  bool started_ = false;
  bool from_silence_ = true;
};

}  // namespace strainwave
