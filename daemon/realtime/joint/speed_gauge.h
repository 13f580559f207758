// SPDX-License-Identifier: BSD-3-Clause
// The speed of a joint that is not under control: a difference over a time in which a count of the encoder weighs little. Real-time safe;
// time is an argument.
//
//   velocity = (position - position before) / (now - then),   then: 50 to 100 ms ago
#pragma once

#include <cmath>
#include <cstdint>

#include "base/durations.h"

namespace strainwave {

class SpeedGauge {
 public:
  /// One fresh position.
  void see(double position_rad, std::int64_t now_ns) noexcept {
    if (seen_ == Seen::kNothing) before_ = last_ = {position_rad, now_ns};
    if (now_ns - last_.at_ns >= kSpan_ns) {
      before_ = last_;
      last_ = {position_rad, now_ns};
    }
    seen_ = now_ns > before_.at_ns ? Seen::kMotion : Seen::kPosition;
    now_ = {position_rad, now_ns};
  }
  /// The joint is under control, or cannot be read: earlier positions are of no use.
  void forget() noexcept { seen_ = Seen::kNothing; }

  /// 0 before two positions have been seen.
  double velocity_rad_s() const noexcept {
    if (seen_ != Seen::kMotion) return 0.0;
    return (now_.position_rad - before_.position_rad) / seconds(now_.at_ns - before_.at_ns);
  }

 private:
  static constexpr std::int64_t kSpan_ns = 50'000'000;
  enum class Seen { kNothing, kPosition, kMotion };
  struct Place {
    double position_rad = 0.0;
    std::int64_t at_ns = 0;
  };
  Seen seen_ = Seen::kNothing;
  Place before_;
  Place last_;
  Place now_;
};

}  // namespace strainwave
