// How old a position is that a drive samples with each SYNC and sends later: from the time stamps that the kernel gives SYNC
// and TPDO. Real-time safe.
//
// A TPDO does not say which SYNC it belongs to. Its delay is measured at start-up, with one SYNC at a time. From there on it is
// followed by its place in the period: after SYNCs without a TPDO, one that comes at another place in the period than before is late by those periods,
// one that comes where it always did is on time and the others were lost; two with one SYNC catch up by a period.
#pragma once

#include <algorithm>
#include <cstdint>

namespace strainwave {

class SampleAge {
 public:
  explicit SampleAge(std::int64_t period_ns) noexcept : period_ns_(period_ns) {}

  /// `delay_ns` >= 0: from SYNC to TPDO, as measured.
  void restart(std::int64_t delay_ns) noexcept {
    usual_lag_ = lag_ = static_cast<int>(delay_ns / period_ns_);
    syncs_ = samples_at_place_ = 0;
    delay_ns_ = delay_ns;
    started_ = false;
  }
  /// Kernel's time; 0: unknown, then nothing is said of the age.
  void sync(std::int64_t time_ns) noexcept {
    sync_ns_ = time_ns;
    ++syncs_;
  }
  void sample(std::int64_t time_ns) noexcept {
    if (sync_ns_ == 0 || time_ns == 0) return;
    // Within a period: an adapter may tell of our SYNC later than of its answer, so which SYNC was the last one shows nothing.
    const std::int64_t phase_ns = within_a_period(time_ns - sync_ns_);
    if (!started_) usual_phase_ns_ = phase_ns;
    const std::int64_t off_ns = within_a_period(phase_ns - usual_phase_ns_);
    const bool at_its_place = std::min(off_ns, period_ns_ - off_ns) <= period_ns_ / kPlaceShare;
    if (started_ && syncs_ == 0 && lag_ > 0) --lag_;
    if (started_ && syncs_ > 1 && !at_its_place) lag_ += syncs_ - 1;
    samples_at_place_ = at_its_place ? samples_at_place_ + 1 : 0;
    // One that is back where it was for so long has caught up unseen.
    if (samples_at_place_ >= kSettled) lag_ = usual_lag_;
    started_ = true;
    syncs_ = 0;
    delay_ns_ = lag_ * period_ns_ + phase_ns;
  }
  /// Of the newest sample, from its SYNC until it came.
  std::int64_t delay_ns() const noexcept { return delay_ns_; }
  /// How many SYNCs later than the newest one before it came it was sampled.
  int lag_periods() const noexcept { return lag_; }

 private:
  /// Of a period: what a TPDO's place may jitter by, on adapters that tell of frames promptly.
  static constexpr std::int64_t kPlaceShare = 5;
  static constexpr int kSettled = 50;

  std::int64_t within_a_period(std::int64_t time_ns) const noexcept {
    const std::int64_t rest_ns = time_ns % period_ns_;
    return rest_ns < 0 ? rest_ns + period_ns_ : rest_ns;
  }

  std::int64_t period_ns_;
  std::int64_t usual_phase_ns_ = 0;
  int usual_lag_ = 0;
  int lag_ = 0;
  std::int64_t sync_ns_ = 0;
  std::int64_t delay_ns_ = 0;
  int syncs_ = 0;  ///< since the last sample
  int samples_at_place_ = 0;
  bool started_ = false;
};

}  // namespace strainwave
