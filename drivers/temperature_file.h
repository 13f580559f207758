// SPDX-License-Identifier: BSD-3-Clause
// A temperature that Linux shows as a file: hwmon and IIO attributes, thermal zones, 1-wire sensors. A read
// may take long (about 750 ms for a 1-wire conversion). So a thread of normal priority reads the file, and
// the loop takes the newest value without waiting. Only newest() is real-time safe, for one thread.
//
// Formats: the kernel's Documentation/hwmon/sysfs-interface.rst, ABI/testing/sysfs-bus-iio,
// w1/slaves/w1_therm.rst. This class drops only text that is not a number, and the power-on value of a 1-wire
// sensor. The loop checks the plausibility (range, rate, age).
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

/// Format of the file.
enum class TemperatureFileKind {
  kNumber,   ///< one number and nothing else: hwmon temp1_input, IIO in_temp_raw, 1-wire `temperature`
  kOneWire,  ///< the two lines of w1_slave: checksum result and t=
};

struct TemperatureFileConfig {
  std::filesystem::path file;
  TemperatureFileKind kind = TemperatureFileKind::kNumber;
  double scale_C = 0.001;                         ///< degC per unit of the number, finite, not 0
  double offset_C = 0.0;                          ///< added after scaling, finite
  double period_s = 1.0;                          ///< from the end of one read to the start of the next, > 0
  std::int64_t (*clock_ns)() noexcept = nullptr;  ///< CLOCK_MONOTONIC; required
};

/// Returns the number in `text`, or nothing when the text does not have the format of `kind`.
std::optional<double> parse_temperature(TemperatureFileKind kind, std::string_view text) noexcept;

class TemperatureFile {
 public:
  /// produced_ns is the time when the read began.
  struct Sample : TemperatureSample {
    bool valid = false;  ///< true once a value has been read
  };

  /// Starts the thread. Throws InputError when the file cannot be opened or the configuration is impossible.
  explicit TemperatureFile(const TemperatureFileConfig& config);
  /// Ends the thread; waits for a read in progress.
  ~TemperatureFile();
  TemperatureFile(const TemperatureFile&) = delete;
  TemperatureFile& operator=(const TemperatureFile&) = delete;

  /// Returns the newest complete value.
  const Sample& newest() noexcept;

  /// Number of reads without a value: file missing, wrong checksum, not a number, or a power-on value. Any thread.
  std::int64_t errors() const noexcept { return errors_.load(std::memory_order_relaxed); }

 private:
  void run(const std::stop_token& stop);
  void read_once();
  bool is_power_on_value(double number, double temperature_C) const noexcept;

  TemperatureFileConfig config_;
  std::optional<double> last_C_;  ///< owned by the thread

  LatestValue<Sample> shared_;
  std::atomic<std::int64_t> errors_{0};
  Sample newest_;  ///< owned by the loop

  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;  // last member, so that the thread ends first
};

}  // namespace strainwave
