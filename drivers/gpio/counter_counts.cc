// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/counter_counts.h"

#include <charconv>

#include "base/input_error.h"

namespace strainwave {

namespace {

constexpr std::uint64_t kDefaultCeiling = 0xFFFFFFFF;

// Writes the configured values and returns the ceiling in force.
std::uint64_t configure(const CounterConfig& config, const std::string& where) {
  const std::filesystem::path& folder = config.count_folder;
  if (std::filesystem::exists(folder / "function"))
    write_attribute(folder / "function", config.function, where);
  if (config.ceiling) write_attribute(folder / "ceiling", std::to_string(*config.ceiling), where);
  std::uint64_t ceiling = kDefaultCeiling;
  if (std::filesystem::exists(folder / "ceiling")) {
    const std::string text = read_attribute(folder / "ceiling", where);
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ceiling);
    if (error != std::errc{} || end != text.data() + text.size() || ceiling < 3)
      throw InputError(where, (folder / "ceiling").string(), text,
                       "3 or more is needed: set ceiling in the configuration");
  }
  if (std::filesystem::exists(folder / "enable")) write_attribute(folder / "enable", "1", where);
  return ceiling;
}

}  // namespace

std::optional<std::int64_t> CountUnwrapper::step(std::uint64_t count) noexcept {
  if (count > ceiling_) return std::nullopt;
  if (begun_) {
    // The modulus of a 64-bit counter, 2^64, wraps to 0; the unsigned arithmetic below is still correct.
    const std::uint64_t modulus = ceiling_ + 1;
    const std::uint64_t up = count >= last_ ? count - last_ : count - last_ + modulus;
    const std::uint64_t down = modulus - up;
    total_ += up <= ceiling_ / 2 ? static_cast<std::int64_t>(up) : -static_cast<std::int64_t>(down);
  }
  begun_ = true;
  last_ = count;
  return total_;
}

CounterCounts::CounterCounts(const CounterConfig& config, const std::string& where)
    : count_(config.count_folder / "count", SysfsFile::Access::kRead, where),
      unwrapper_(configure(config, where)) {}

CountSource::Sample CounterCounts::read(std::int64_t /*now_ns*/) noexcept {
  const auto count = count_.read();
  if (!count) return {counts_, State::kStale};
  const auto total = unwrapper_.step(*count);
  if (total)
    counts_ = *total;
  else
    implausible_ = true;
  return {counts_, implausible_ ? State::kImplausible : State::kFresh};
}

}  // namespace strainwave
