// A temperature and its time in one word, so that a background thread can hand it to the loop without a lock.
// Real-time safe.
#pragma once

#include <atomic>
#include <bit>
#include <cstdint>

namespace strainwave {

class PackedTemperature {
 public:
  /// `time_ns` is CLOCK_MONOTONIC when the value was asked for.
  void put(double temperature_C, std::int64_t time_ns) noexcept {
    const std::uint64_t value = std::bit_cast<std::uint32_t>(static_cast<float>(temperature_C));
    word_.store(value << 32U | stamp(time_ns), std::memory_order_release);
    there_.store(true, std::memory_order_release);
  }
  /// False before the first value. An age is right up to 24 days.
  bool get(std::int64_t now_ns, double& temperature_C, std::int64_t& age_ns) const noexcept {
    if (!there_.load(std::memory_order_acquire)) return false;
    const std::uint64_t word = word_.load(std::memory_order_acquire);
    temperature_C = static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(word >> 32U)));
    // The loop's time may be that of a cycle which began before the value came.
    const auto age_ms = static_cast<std::int32_t>(stamp(now_ns) - static_cast<std::uint32_t>(word));
    age_ns = age_ms < 0 ? 0 : std::int64_t{age_ms} * kMillisecond_ns;
    return true;
  }

 private:
  static constexpr std::int64_t kMillisecond_ns = 1'000'000;
  static std::uint32_t stamp(std::int64_t time_ns) noexcept {
    return static_cast<std::uint32_t>(time_ns / kMillisecond_ns);
  }

  std::atomic<std::uint64_t> word_{0};
  std::atomic<bool> there_{false};
};

}  // namespace strainwave
