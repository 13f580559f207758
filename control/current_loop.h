// The torque behind a drive's current loop, of first order: what acts lags what was commanded. Real-time safe. Joint side, SI.
//
//   i' = (u - i) / tau                                      u: commanded, held over a period; i: what acts
//   mean over a period     m = u + (i - u) c                c = tau / T (1 - exp(-T / tau))
//   at its end            i+ = u + (i - u) exp(-T / tau)
//   command for a mean     u = (m - i c) / (1 - c)          c < 1
//
// Without a lag what is commanded acts.
#pragma once

#include <cmath>

namespace strainwave {

/// Several periods of 1 kHz: no drive's is as slow.
inline constexpr double kLongestCurrentLoop_s = 5e-3;

class CurrentLoop {
 public:
  /// `time_constant_s` >= 0; `period_s` > 0.
  CurrentLoop(double time_constant_s, double period_s) noexcept
      : kept_(time_constant_s > 0.0 ? std::exp(-period_s / time_constant_s) : 0.0),
        mean_share_(time_constant_s / period_s * (1.0 - kept_)) {}

  bool lags() const noexcept { return mean_share_ > 0.0; }
  /// Over a period that begins while `acting_Nm` acts.
  double mean_Nm(double commanded_Nm, double acting_Nm) const noexcept {
    return lags() ? commanded_Nm + (acting_Nm - commanded_Nm) * mean_share_ : commanded_Nm;
  }
  double end_Nm(double commanded_Nm, double acting_Nm) const noexcept {
    return lags() ? commanded_Nm + (acting_Nm - commanded_Nm) * kept_ : commanded_Nm;
  }
  /// What has to be commanded for that mean.
  double command_Nm(double mean_Nm, double acting_Nm) const noexcept {
    return lags() ? (mean_Nm - acting_Nm * mean_share_) / (1.0 - mean_share_) : mean_Nm;
  }

 private:
  double kept_;        ///< of the difference over a period
  double mean_share_;  ///< c
};

}  // namespace strainwave
