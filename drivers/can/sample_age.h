// SPDX-License-Identifier: BSD-3-Clause
// The age of a position that a drive samples at each SYNC and sends later. It is derived from the kernel's
// time stamps of SYNC and TPDO. Real-time safe.
//
// A TPDO does not say which SYNC it belongs to. Start-up measures its delay at the loop's rate. Afterwards this class
// watches three things:
//
//   place in the period       After SYNCs without a TPDO, a TPDO at another place than start-up measured is late by those periods.
//                             Two TPDOs with one SYNC catch up by a period. A TPDO that stays at another place without
//                             such a reason is displaced: its lateness in periods is unknown.
//   first position            It belongs to the first SYNC: the bus was silent before. Its lateness stays until TPDO2 comes earlier.
//   place of TPDO2            The drive sends TPDO2 with every nth SYNC. Lateness of whole periods leaves TPDO1 at its place, as if
//                             some were lost, but moves TPDO2 among the SYNCs.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstdlib>

namespace strainwave {

class SampleAge {
 public:
  /// `slow_every`: number of SYNCs between two TPDO2; with 1, TPDO2 gives no information.
  SampleAge(std::int64_t period_ns, int slow_every) noexcept
      : period_ns_(period_ns), slow_every_(slow_every) {}

  /// `delay_ns` >= 0: measured delay from SYNC to TPDO.
  void restart(std::int64_t delay_ns) noexcept {
    usual_lag_ = lag_ = static_cast<int>(delay_ns / period_ns_);
    syncs_ = samples_at_place_ = displaced_samples_ = 0;
    delay_ns_ = delay_ns;
    usual_phase_ns_ = moved_phase_ns_ = within_a_period(delay_ns);
    started_ = false;
    // Only before the first SYNC was the bus silent. At a later restart the SYNC of the first position is unknown.
    from_silence_ = sync_count_ == 0;
    slow_ = {};
  }
  /// Kernel time of a SYNC; 0: unknown, then the age is not updated.
  void sync(std::int64_t time_ns) noexcept {
    sync_ns_ = time_ns;
    if (first_sync_ns_ == 0) first_sync_ns_ = time_ns;
    ++syncs_;
    ++sync_count_;
  }
  void sample(std::int64_t time_ns) noexcept {
    if (sync_ns_ == 0 || time_ns == 0) return;
    // The phase is taken modulo the period. An adapter may report our SYNC after the answer to it, so the last SYNC seen proves nothing.
    const std::int64_t phase_ns = within_a_period(time_ns - sync_ns_);
    const bool at_its_place = near(phase_ns, usual_phase_ns_);
    if (!started_ && from_silence_) slow_.late_from_start = periods_late_at_start(time_ns, at_its_place);
    if (started_ && syncs_ != 1) moved_phase_ns_ = phase_ns;
    displaced_samples_ =
        at_its_place || near(phase_ns, moved_phase_ns_) ? 0 : std::min(displaced_samples_ + 1, kSettled);
    if (started_ && syncs_ == 0 && lag_ > 0) --lag_;
    if (started_ && syncs_ > 1 && !at_its_place) lag_ += syncs_ - 1;
    samples_at_place_ = at_its_place ? samples_at_place_ + 1 : 0;
    // A TPDO that stays at its usual place for so long has caught up unnoticed.
    if (samples_at_place_ >= kSettled) lag_ = usual_lag_;
    started_ = true;
    syncs_ = 0;
    delay_ns_ = lag_periods() * period_ns_ + phase_ns;
  }
  /// Takes the time of a TPDO2.
  void slow_sample(std::int64_t time_ns) noexcept {
    if (sync_ns_ == 0 || time_ns == 0 || slow_every_ < 2) return;
    const std::int64_t since_ns = time_ns - sync_ns_;
    const std::int64_t came_with = sync_count_ + (since_ns - within_a_period(since_ns)) / period_ns_;
    if (!slow_.started) slow_.usual = came_with;
    slow_.started = true;
    slow_.see(around_zero(came_with - slow_.usual));
  }
  /// Delay of the newest sample, from its SYNC to its arrival.
  std::int64_t delay_ns() const noexcept { return delay_ns_; }
  /// The TPDO arrives at another place in the period than start-up measured, without a known reason.
  bool displaced() const noexcept { return displaced_samples_ >= kSettled; }
  /// Number of SYNCs between the SYNC of the sample and the last one before its arrival.
  int lag_periods() const noexcept { return std::max(lag_, usual_lag_ + slow_.late_from_start + slow_.late); }
  /// Lateness in periods beyond the delay that start-up measured. No SYNC was sent in the last `left_out`
  /// periods, which makes the sample older by that number, less the usual lag.
  int late_periods(int left_out = 0) const noexcept {
    return lag_periods() - usual_lag_ + std::max(0, left_out - usual_lag_);
  }

 private:
  /// Allowed jitter of a TPDO's place is period / kPlaceShare, on adapters that report frames promptly.
  static constexpr std::int64_t kPlaceShare = 5;
  static constexpr int kSettled = 50;
  /// Number of consecutive TPDO2 that must agree: a single one may wait behind other frames.
  static constexpr int kAgreeing = 3;

  /// The place of TPDO2 among the SYNCs.
  struct SlowPlace {
    void see(std::int64_t off) noexcept {
      const bool agrees = in_a_row > 0 && (off > 0) == (least > 0) && off != 0;
      in_a_row = off == 0 ? 0 : agrees ? in_a_row + 1 : 1;
      if (!agrees || std::abs(off) < std::abs(least)) least = off;
      if (off == 0) late = 0;
      if (in_a_row < kAgreeing) return;
      // A drive cannot answer before the SYNC. An early TPDO2 has caught up, or belongs to a SYNC that was not seen here.
      if (least < 0) {
        usual += least;
        late_from_start = std::max(late_from_start + static_cast<int>(least), 0);
      }
      late = least > 0 ? static_cast<int>(least) : 0;
      if (least < 0) in_a_row = 0;
    }
    std::int64_t usual = 0;   ///< number of a SYNC with which TPDO2 came on time
    std::int64_t least = 0;   ///< smallest offset among those in a row
    int in_a_row = 0;         ///< number of consecutive offsets of the same sign
    int late = 0;             ///< periods, relative to `usual`
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
  /// Lateness of the first position, beyond the usual lag.
  int periods_late_at_start(std::int64_t time_ns, bool at_its_place) const noexcept {
    const std::int64_t since_ns =
        time_ns - first_sync_ns_ + (at_its_place ? period_ns_ / 2 - usual_phase_ns_ : 0);
    return static_cast<int>(std::max<std::int64_t>(since_ns / period_ns_ - usual_lag_, 0));
  }
  /// Returns the offset among the SYNCs between two TPDO2, from -slow_every / 2 to slow_every / 2.
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
