// SPDX-License-Identifier: BSD-3-Clause
// The mean of a motion over the last periods. It smooths the motion and extends it by the mean's width. Real-time safe.
// Source: Singer and Seering (1990), shaping by convolution.
//
//   y(t) = 1/w  integral of x(s) over s = t - w .. t,      w: whole periods
//   y'   = (x(t) - x(t - w)) / w
//   y''  = (x'(t) - x'(t - w)) / w
//
// Exact for a motion that is cubic between samples. Constant acceleration is therefore exact through one mean, and through two in a row.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>

namespace strainwave {

inline constexpr int kMaxMeanPeriods = 64;

/// A motion at a sample.
struct MotionPoint {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
  double jerk_rad_s3 = 0.0;
};

class MovingMean {
 public:
  /// `periods` in 0..kMaxMeanPeriods, 0: leaves the motion as it is; `period_s` > 0.
  MovingMean(int periods, double period_s) noexcept : periods_(periods), period_s_(period_s) {
    assert(periods >= 0 && periods <= kMaxMeanPeriods);
  }

  /// Assumes a past motion at this velocity that is now at `position_rad`.
  void reset(double position_rad, double velocity_rad_s = 0.0) noexcept {
    for (std::size_t i = 0; i < samples_.size(); ++i)
      samples_[i] = {position_rad - static_cast<double>(samples_.size() - 1 - i) * period_s_ * velocity_rad_s,
                     velocity_rad_s, 0.0, 0.0};
    newest_ = samples_.size() - 1;
  }
  /// Delay of the mean behind the motion.
  double lag_s() const noexcept { return 0.5 * periods_ * period_s_; }

  /// Takes the motion's next sample, whose jerk is not used. Returns the mean.
  MotionPoint step(const MotionPoint& sample) noexcept {
    newest_ = (newest_ + 1) % samples_.size();
    samples_[newest_] = sample;
    if (periods_ == 0) return {sample.position_rad, sample.velocity_rad_s, sample.acceleration_rad_s2, 0.0};
    // Relative to the newest position: after the end of a motion no rounding remains.
    double sum_rad = 0.0;
    for (int i = 0; i < periods_; ++i) {
      const MotionPoint& after = ago(i);
      const MotionPoint& before = ago(i + 1);
      sum_rad +=
          0.5 * ((before.position_rad - sample.position_rad) + (after.position_rad - sample.position_rad)) +
          period_s_ * (before.velocity_rad_s - after.velocity_rad_s) / 12.0;
    }
    const MotionPoint& oldest = ago(periods_);
    const double width_s = periods_ * period_s_;
    return {sample.position_rad + sum_rad / periods_, (sample.position_rad - oldest.position_rad) / width_s,
            (sample.velocity_rad_s - oldest.velocity_rad_s) / width_s,
            (sample.acceleration_rad_s2 - oldest.acceleration_rad_s2) / width_s};
  }

 private:
  const MotionPoint& ago(int periods) const noexcept {
    return samples_[(newest_ + samples_.size() - static_cast<std::size_t>(periods)) % samples_.size()];
  }

  int periods_;
  double period_s_;
  std::size_t newest_ = 0;
  std::array<MotionPoint, kMaxMeanPeriods + 1> samples_{};
};

}  // namespace strainwave
