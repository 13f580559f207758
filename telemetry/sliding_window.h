// SPDX-License-Identifier: BSD-3-Clause
// The largest value of the last minute, so that periodic scrapes miss no peak. Time is an argument. Not real-time.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace strainwave {

/// The largest magnitude in slots of ten seconds. The last six slots and the current one count: 60 to 70 s.
class RecentPeak {
 public:
  /// `now_s` must not decrease.
  void take(double value, double now_s) {
    const std::int64_t number = slot_at(now_s);
    Slot& slot = slots_[static_cast<std::size_t>(number) % kSlots];
    if (slot.number != number) slot = {number, 0.0};
    slot.peak = std::fmax(slot.peak, std::fabs(value));
  }
  double amount(double now_s) const {
    double peak = 0.0;
    for (const Slot& slot : slots_)
      if (slot.number > slot_at(now_s) - static_cast<std::int64_t>(kSlots)) peak = std::fmax(peak, slot.peak);
    return peak;
  }

 private:
  static constexpr double kSlot_s = 10.0;
  static constexpr std::size_t kSlots = 7;
  static std::int64_t slot_at(double now_s) { return static_cast<std::int64_t>(std::floor(now_s / kSlot_s)); }

  struct Slot {
    std::int64_t number = -1;
    double peak = 0.0;
  };
  std::array<Slot, kSlots> slots_{};
};

}  // namespace strainwave
