// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/temperature_file.h"

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <signal.h>
#include <unistd.h>

#include <array>
#include <cassert>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cmath>
#include <string>
#include <system_error>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/unique_fd.h"

namespace strainwave {

namespace {

constexpr std::size_t kMaxBytes = 256;  // a w1_slave file has about 75 bytes
constexpr std::string_view kWhitespace = " \t\n";
/// A DS18B20 reports this value until its first conversion and after a loss of supply.
constexpr double kOneWirePowerOn_mC = 85000.0;
constexpr double kNearPowerOn_C = 2.0;

std::string_view trimmed(std::string_view text) noexcept {
  const std::size_t first = text.find_first_not_of(kWhitespace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kWhitespace) - first + 1);
}

std::optional<double> whole_number(std::string_view text) noexcept {
  text = trimmed(text);
  double number = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

UniqueFd open_file(const std::filesystem::path& path) {
  return UniqueFd(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
}

void check(const TemperatureFileConfig& config) {
  const auto require = [&](bool good, const char* key, double value, const char* allowed) {
    if (!good) throw InputError("thermometer", key, number_text(value), allowed);
  };
  require(std::isfinite(config.scale_C) && config.scale_C != 0.0, "scale_C", config.scale_C,
          "must be finite and not 0");
  require(std::isfinite(config.offset_C), "offset_C", config.offset_C, "must be finite");
  require(std::isfinite(config.period_s) && config.period_s > 0.0, "period_s", config.period_s,
          "must be finite and > 0");
  if (const UniqueFd file = open_file(config.file); !file)
    throw InputError("thermometer", "file", config.file.string(),
                     "cannot be opened (" + std::generic_category().message(errno) +
                         "): is the sensor's driver loaded, and does the name still hold after a restart?");
}

}  // namespace

std::optional<double> parse_temperature(TemperatureFileKind kind, std::string_view text) noexcept {
  if (kind == TemperatureFileKind::kNumber) return whole_number(text);
  // "72 01 4b 46 7f ff 0e 10 57 : crc=57 YES" and "72 01 4b 46 7f ff 0e 10 57 t=23125"
  const std::size_t line_end = text.find('\n');
  if (line_end == std::string_view::npos) return std::nullopt;
  const std::string_view verdict = trimmed(text.substr(0, line_end));
  const std::string_view values = trimmed(text.substr(line_end + 1));
  const std::size_t mark = values.rfind("t=");
  if (!verdict.ends_with(" YES") || mark == std::string_view::npos) return std::nullopt;
  return whole_number(values.substr(mark + 2));
}

TemperatureFile::TemperatureFile(const TemperatureFileConfig& config) : config_(config) {
  assert(config_.clock_ns != nullptr);
  check(config_);
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

TemperatureFile::~TemperatureFile() = default;

void TemperatureFile::run(const std::stop_token& stop) {
  // The creating thread may be real-time or handle signals; this thread must do neither.
  const sched_param ordinary{};
  ::pthread_setschedparam(::pthread_self(), SCHED_OTHER, &ordinary);
  sigset_t all;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_BLOCK, &all, nullptr);
  std::unique_lock lock(mutex_);
  while (!stop.stop_requested()) {
    read_once();
    wake_.wait_for(lock, stop, std::chrono::duration<double>(config_.period_s), [] { return false; });
  }
}

void TemperatureFile::read_once() {
  const std::int64_t began_ns = config_.clock_ns();
  // The file is opened for each read: a reconnected sensor appears as a new file with the same name.
  const UniqueFd file = open_file(config_.file);
  std::array<char, kMaxBytes> bytes{};
  const ssize_t size = !file ? -1 : ::read(file.get(), bytes.data(), bytes.size());
  std::optional<double> number;
  if (size > 0 && static_cast<std::size_t>(size) < bytes.size())
    number = parse_temperature(config_.kind, {bytes.data(), static_cast<std::size_t>(size)});
  const double temperature_C = number ? *number * config_.scale_C + config_.offset_C : 0.0;
  if (!number || !std::isfinite(temperature_C) || is_power_on_value(*number, temperature_C)) {
    errors_.fetch_add(1, std::memory_order_relaxed);
    return;
  }
  last_C_ = temperature_C;
  shared_.put({temperature_C, began_ns, true});
}

// A reading of exactly 85 degC is accepted only if the previous value was close to it.
bool TemperatureFile::is_power_on_value(double number, double temperature_C) const noexcept {
  return config_.kind == TemperatureFileKind::kOneWire && number == kOneWirePowerOn_mC &&
         !(last_C_ && std::abs(*last_C_ - temperature_C) < kNearPowerOn_C);
}

const TemperatureFile::Sample& TemperatureFile::newest() noexcept {
  (void)shared_.take(newest_);
  return newest_;
}

}  // namespace strainwave
