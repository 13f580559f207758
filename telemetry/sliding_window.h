// SPDX-License-Identifier: BSD-3-Clause
// What was largest, and what was the mean, over the last minute: a scrape every so often must not miss what happened between. Time is an
// argument. Not real-time.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace strainwave {

/// Slots of ten seconds, of which the last six and the one under way count: 60 to 70 s.
template <typename Slot>
class SlidingWindow {
 public:
  static constexpr double kSlot_s = 10.0;
  static constexpr std::size_t kSlots = 7;

  /// The slot of `now_s`, empty when it is new. Time must not go back.
  Slot& at(double now_s) {
    const auto number = static_cast<std::int64_t>(std::floor(now_s / kSlot_s));
    Numbered& place = slots_[static_cast<std::size_t>(number) % kSlots];
    if (place.number != number) place = {number, Slot{}};
    return place.slot;
  }

  /// Calls visit(slot) for those that count.
  template <typename Visit>
  void visit(double now_s, Visit&& visit) const {
    const auto number = static_cast<std::int64_t>(std::floor(now_s / kSlot_s));
    for (const Numbered& place : slots_)
      if (place.number > number - static_cast<std::int64_t>(kSlots) && place.number >= 0) visit(place.slot);
  }

 private:
  struct Numbered {
    std::int64_t number = -1;
    Slot slot{};
  };
  std::array<Numbered, kSlots> slots_{};
};

/// The largest amount.
class RecentPeak {
 public:
  void take(double value, double now_s) {
    double& peak = window_.at(now_s);
    peak = std::fmax(peak, std::fabs(value));
  }
  double amount(double now_s) const {
    double peak = 0.0;
    window_.visit(now_s, [&](double slot) { peak = std::fmax(peak, slot); });
    return peak;
  }

 private:
  SlidingWindow<double> window_;
};

/// The mean; nothing when nothing was taken.
class RecentMean {
 public:
  void take(double value, double now_s) {
    Sum& sum = window_.at(now_s);
    sum.sum += value;
    ++sum.count;
  }
  std::optional<double> mean(double now_s) const {
    Sum all;
    window_.visit(now_s, [&](const Sum& slot) {
      all.sum += slot.sum;
      all.count += slot.count;
    });
    if (all.count == 0) return std::nullopt;
    return all.sum / static_cast<double>(all.count);
  }

 private:
  struct Sum {
    double sum = 0.0;
    std::int64_t count = 0;
  };
  SlidingWindow<Sum> window_;
};

}  // namespace strainwave
