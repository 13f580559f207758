// SPDX-License-Identifier: BSD-3-Clause
// Checks the temperature signal, and selects the value for gain scheduling. Real-time safe; time is an argument.
#pragma once

#include <cstdint>
#include <limits>

#include "strainwave/vocabulary.h"

namespace strainwave {

struct TemperatureCheckConfig {
  double min_C = -40.0;  ///< plausible range of the sensor
  double max_C = 90.0;
  double max_rate_C_s = 20.0;  ///< faster lasting changes are not heat but a broken wire
  double max_step_C = 6.0;     ///< a reading may always differ by this much from the recent past
  double max_age_s = 5.0;      ///< older values are not used
  bool loss_is_fault = false;  ///< a joint under control that loses its temperature stops
};

class TemperatureCheck {
 public:
  explicit TemperatureCheck(const TemperatureCheckConfig& config) noexcept : config_(config) {}

  /// One reading. `produced_ns` is when the sensor produced it (monotonic), `now_ns` the present.
  void update(bool has_reading, double temperature_C, std::int64_t produced_ns, std::int64_t now_ns) noexcept;

  TemperatureStatus status() const noexcept { return status_; }
  /// Whether any value has been plausible.
  bool known() const noexcept { return known_; }
  /// The last plausible value; meaningful only once it is known.
  double used_C() const noexcept { return accepted_C_; }
  /// From used_C() to `limit_C`; NaN while the signal is not valid.
  double margin_C(double limit_C) const noexcept {
    return status_ == TemperatureStatus::kValid ? limit_C - accepted_C_
                                                : std::numeric_limits<double>::quiet_NaN();
  }
  /// The sensor's last value, plausible or not; NaN before the first.
  double measured_C() const noexcept { return measured_C_; }
  /// Whether the sensor's last value is above `limit_C`. Includes implausible values, which may be real.
  bool hotter_than(double limit_C) const noexcept { return seen() && measured_C_ > limit_C; }
  /// Whether the loss of the signal must stop the joint.
  bool lost() const noexcept { return config_.loss_is_fault && status_ != TemperatureStatus::kValid; }
  double age_s(std::int64_t now_ns) const noexcept;

 private:
  bool seen() const noexcept { return status_ != TemperatureStatus::kNeverSeen; }
  TemperatureStatus judge(double temperature_C, std::int64_t produced_ns, std::int64_t now_ns) const noexcept;

  TemperatureCheckConfig config_;
  TemperatureStatus status_ = TemperatureStatus::kNeverSeen;
  bool known_ = false;
  double measured_C_ = std::numeric_limits<double>::quiet_NaN();
  double accepted_C_ = 0.0;
  double recent_C_ = 0.0;  ///< accepted readings, low-passed so that a ramp of max_rate lags by max_step
  std::int64_t measured_ns_ = 0;
  std::int64_t accepted_ns_ = 0;
};

}  // namespace strainwave
