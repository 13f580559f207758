// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/temperature_check.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/durations.h"

namespace strainwave {

double TemperatureCheck::age_s(std::int64_t now_ns) const noexcept {
  // Another thread may have read its sensor after this period's instant.
  return seen() ? std::max(0.0, seconds(now_ns - measured_ns_)) : -1.0;
}

TemperatureStatus TemperatureCheck::judge(double temperature_C, std::int64_t produced_ns,
                                          std::int64_t now_ns) const noexcept {
  if (!std::isfinite(temperature_C) || temperature_C < config_.min_C || temperature_C > config_.max_C)
    return TemperatureStatus::kOutOfRange;
  if (seconds(now_ns - produced_ns) > config_.max_age_s) return TemperatureStatus::kTooOld;
  if (known_) {
    // Compares with the recent past, not the last reading, so that a fast drift cannot pass in small steps. The allowed
    // change grows with the time since the last accepted reading, so that the signal can return.
    const double silence_s = std::max(0.0, seconds(produced_ns - accepted_ns_));
    const double allowed_C = config_.max_step_C + config_.max_rate_C_s * silence_s;
    if (std::abs(temperature_C - recent_C_) > allowed_C) return TemperatureStatus::kTooFast;
  }
  return TemperatureStatus::kValid;
}

void TemperatureCheck::update(bool has_reading, double temperature_C, std::int64_t produced_ns,
                              std::int64_t now_ns) noexcept {
  if (has_reading) {
    measured_C_ = std::isfinite(temperature_C) ? temperature_C : std::numeric_limits<double>::quiet_NaN();
    measured_ns_ = produced_ns;
    status_ = judge(temperature_C, produced_ns, now_ns);
  } else if (seen() && seconds(now_ns - measured_ns_) > config_.max_age_s) {
    status_ = TemperatureStatus::kTooOld;
  }

  if (!has_reading || status_ != TemperatureStatus::kValid) return;
  const double time_constant_s = config_.max_step_C / config_.max_rate_C_s;
  const double elapsed_s = std::max(0.0, seconds(produced_ns - accepted_ns_));
  recent_C_ = known_ ? recent_C_ + (temperature_C - recent_C_) * elapsed_s / (time_constant_s + elapsed_s)
                     : temperature_C;
  accepted_C_ = temperature_C;
  accepted_ns_ = produced_ns;
  known_ = true;
}

}  // namespace strainwave
