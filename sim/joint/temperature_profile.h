// SPDX-License-Identifier: BSD-3-Clause
// Ambient temperature over time: a TimeProfile in degC that stays above absolute zero. at() is real-time
// safe. The factories are not, and throw InputError.
#pragma once

#include "sim/joint/time_profile.h"

namespace strainwave {

class TemperatureProfile {
 public:
  /// 25 degC throughout.
  TemperatureProfile() : TemperatureProfile(TimeProfile::constant(25.0, quantity())) {}

  static TemperatureProfile constant(double temperature_C) {
    return {TimeProfile::constant(temperature_C, quantity())};
  }
  /// See TimeProfile.
  static TemperatureProfile steps(double start_C, double rise_C, double interval_s, double count) {
    return {TimeProfile::steps(start_C, rise_C, interval_s, count, quantity())};
  }
  static TemperatureProfile sine(double mean_C, double amplitude_C, double angular_frequency_rad_s) {
    return {TimeProfile::sine(mean_C, amplitude_C, angular_frequency_rad_s, quantity())};
  }
  /// Columns time_s, ambient_temperature_C; straight lines between the rows.
  static TemperatureProfile from_csv(const std::filesystem::path& path) {
    return {TimeProfile::from_csv(path, false, quantity())};
  }
  /// "constant:25", "steps:-10,5,1,11", "ramp:25,-10,5,65", "sine:15,25,1", "csv:FILE" or "hold:FILE", relative to `folder`.
  static TemperatureProfile parse(std::string_view text, const std::filesystem::path& folder = {}) {
    return {TimeProfile::parse(text, quantity(), folder)};
  }

  /// Temperature in degC at `time_s`.
  double at(double time_s) const noexcept { return profile_.at(time_s); }

 private:
  TemperatureProfile(TimeProfile profile) : profile_(std::move(profile)) {}
  static ProfileQuantity quantity() { return {"ambient_temperature_C", -273.15, 1e4}; }

  TimeProfile profile_;
};

}  // namespace strainwave
