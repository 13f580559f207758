// SPDX-License-Identifier: BSD-3-Clause
// A quantity over time: constant, steps, a ramp, square, sine, or a recorded CSV. Setpoints, loads and
// temperatures are time profiles. at() is real-time safe; everything else is not.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

/// The quantity of a profile: its name in messages and as the CSV column, and its allowed range.
struct ProfileQuantity {
  std::string key;  ///< e.g. "ambient_temperature_C"
  double min = -std::numeric_limits<double>::max();
  double max = std::numeric_limits<double>::max();
};

class TimeProfile {
 public:
  /// 0 throughout.
  TimeProfile() = default;

  static TimeProfile constant(double value, const ProfileQuantity& quantity);
  /// `start`, then `rise` more at every whole multiple of `interval_s` > 0, `count` >= 1 times.
  static TimeProfile steps(double start, double rise, double interval_s, double count,
                           const ProfileQuantity& quantity);
  /// `first` until `begin_s`, a straight line to `second` at `end_s` > `begin_s`, then `second`.
  static TimeProfile ramp(double first, double second, double begin_s, double end_s,
                          const ProfileQuantity& quantity);
  /// `first` and `second` in turn, `interval_s` > 0 each.
  static TimeProfile square(double first, double second, double interval_s, const ProfileQuantity& quantity);
  /// mean + amplitude sin(angular_frequency t).
  static TimeProfile sine(double mean, double amplitude, double angular_frequency_rad_s,
                          const ProfileQuantity& quantity);
  /// Columns time_s and quantity.key, times strictly rising. The first value holds before its row, and the last after
  /// its row. Between two rows the value follows a straight line or, with `hold`, keeps that of the earlier row.
  static TimeProfile from_csv(const std::filesystem::path& path, bool hold, const ProfileQuantity& quantity);
  /// "constant:25", "steps:-10,5,1,11", "ramp:0,20,1,3", "square:0,1,0.5", "sine:15,25,1", "csv:FILE" (straight
  /// lines) or "hold:FILE", with the arguments of the factories above. One step of 20 at 1 s is "steps:0,20,1,1".
  /// FILE is relative to `folder`, by default the working directory. All factories throw InputError.
  static TimeProfile parse(std::string_view text, const ProfileQuantity& quantity,
                           const std::filesystem::path& folder = {});

  /// The value at `time_s`.
  double at(double time_s) const noexcept;

 private:
  enum class Kind { kConstant, kSteps, kSquare, kSine, kLines, kHold };
  struct Point {
    double time_s, value;
  };
  double interpolate(double time_s) const noexcept;

  Kind kind_ = Kind::kConstant;
  double base_ = 0.0;    ///< constant, start, first or mean
  double change_ = 0.0;  ///< rise, second minus first, or amplitude
  double rate_ = 1.0;    ///< interval_s or angular frequency
  double count_ = 0.0;   ///< number of steps
  std::vector<Point> points_;
};

}  // namespace strainwave
