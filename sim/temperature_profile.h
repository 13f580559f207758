// Ambient temperature over time: constant, steps, sine, or a recorded CSV. at() is real-time safe; the
// factories are not.
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

namespace strainwave {

class TemperatureProfile {
 public:
  /// 25 degC throughout.
  TemperatureProfile() = default;

  static TemperatureProfile constant(double temperature_C);
  /// `start_C`, then `rise_C` more at every whole multiple of `interval_s` > 0, `count` >= 1 times.
  static TemperatureProfile steps(double start_C, double rise_C, double interval_s, double count);
  /// mean + amplitude sin(angular_frequency t).
  static TemperatureProfile sine(double mean_C, double amplitude_C, double angular_frequency_rad_s);
  /// Columns time_s, temperature_C, times strictly rising; straight lines between the rows, held before and
  /// after.
  static TemperatureProfile from_csv(const std::filesystem::path& path);
  /// "constant:25", "steps:-10,5,1,11", "sine:15,25,1" or "csv:FILE", arguments as above. All throw
  /// InputError.
  static TemperatureProfile parse(std::string_view text);

  /// Temperature in degC at `time_s`.
  double at(double time_s) const noexcept;

 private:
  enum class Kind { kConstant, kSteps, kSine, kPoints };
  struct Point {
    double time_s, temperature_C;
  };
  double interpolate(double time_s) const noexcept;

  Kind kind_ = Kind::kConstant;
  double base_C_ = 25.0;   ///< constant, start or mean
  double change_C_ = 0.0;  ///< rise or amplitude
  double rate_ = 1.0;      ///< interval_s or angular frequency
  double count_ = 0.0;     ///< number of steps
  std::vector<Point> points_;
};

}  // namespace strainwave
