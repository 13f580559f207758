// SPDX-License-Identifier: BSD-3-Clause
// A temperature that Linux shows as a file: hwmon and IIO attributes, thermal zones, 1-wire sensors. Such a
// read may take long (a 1-wire conversion about 750 ms), so a thread of normal priority reads now and then,
// and the loop takes the newest value without waiting. Only newest() is real-time safe, for one thread.
//
// Formats: the kernel's Documentation/hwmon/sysfs-interface.rst, ABI/testing/sysfs-bus-iio,
// w1/slaves/w1_therm.rst. Whether a value can be believed is the loop's judgement (range, rate, age); here
// only what is no number at all is dropped.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string_view>
#include <thread>

#include "base/latest_value.h"
#include "drivers/temperature_sample.h"

namespace strainwave {

/// What the file holds.
enum class TemperatureFileKind {
  kNumber,   ///< one number and nothing else: hwmon temp1_input, IIO in_temp_raw, 1-wire `temperature`
  kOneWire,  ///< the two lines of w1_slave: a checksum verdict and t=
};

struct TemperatureFileConfig {
  std::filesystem::path file;
  TemperatureFileKind kind = TemperatureFileKind::kNumber;
  double scale_C = 0.001;                         ///< degC per unit of the number, finite, not 0
  double offset_C = 0.0;                          ///< added after scaling, finite
  double period_s = 1.0;                          ///< from the end of one read to the begin of the next, > 0
  std::int64_t (*clock_ns)() noexcept = nullptr;  ///< CLOCK_MONOTONIC; required
};

/// The number in `text`, or nothing when it is not exactly what `kind` promises.
std::optional<double> parse_temperature(TemperatureFileKind kind, std::string_view text) noexcept;

class TemperatureFile {
 public:
  /// Its instant is when the read began.
  struct Sample : TemperatureSample {
    bool valid = false;  ///< any value since the start
  };

  /// Starts the thread. Throws InputError when the file cannot be opened or the configuration is impossible.
  explicit TemperatureFile(const TemperatureFileConfig& config);
  /// Ends it; waits for a read that is under way.
  ~TemperatureFile();
  TemperatureFile(const TemperatureFile&) = delete;
  TemperatureFile& operator=(const TemperatureFile&) = delete;

  /// The newest value that is whole.
  const Sample& newest() noexcept;

  /// Reads that gave no number: file gone, checksum wrong, not a number. Any thread.
  std::int64_t errors() const noexcept { return errors_.load(std::memory_order_relaxed); }

 private:
  void run(const std::stop_token& stop);
  void read_once();
  bool is_power_on_value(double number, double temperature_C) const noexcept;

  TemperatureFileConfig config_;
  std::optional<double> last_C_;  ///< the thread's

  LatestValue<Sample> shared_;
  std::atomic<std::int64_t> errors_{0};
  Sample newest_;  ///< the loop's

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last: ends first
};

}  // namespace strainwave
