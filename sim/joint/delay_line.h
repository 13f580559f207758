// SPDX-License-Identifier: BSD-3-Clause
// The delay between a command and its effect, in fractions of a period, with jitter. Real-time safe. Time is counted in periods.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>

namespace strainwave {

inline constexpr double kMaxDelayPeriods = 16.0;

struct DelayConfig {
  double periods = 0.0;         ///< 0..kMaxDelayPeriods
  double jitter_periods = 0.0;  ///< additional delay of each command, uniform from 0 to this; 0..4
  std::uint64_t seed = 1;       ///< seed of the jitter
};

/// Keeps each command until it is due. A command never overtakes an earlier one.
class DelayLine {
 public:
  explicit DelayLine(const DelayConfig& config) noexcept : config_(config), random_(config.seed) {}

  /// Takes a command at `now`.
  void push(double now, double torque_Nm) noexcept {
    double due = now + config_.periods;
    // The results of standard distributions depend on the library; this formula makes a run the same everywhere.
    if (config_.jitter_periods > 0.0)
      due += config_.jitter_periods * static_cast<double>(random_() >> 11U) * 0x1p-53;
    if (count_ > 0) due = due > newest().due ? due : newest().due;
    if (count_ == waiting_.size()) drop_oldest();
    waiting_[(first_ + count_) % waiting_.size()] = {due, torque_Nm};
    ++count_;
  }
  /// The torque that acts from `now` on.
  double at(double now) noexcept {
    while (count_ > 0 && waiting_[first_].due <= now) drop_oldest();
    return acting_Nm_;
  }
  /// When the next command takes over; infinity when none waits.
  double next_due() const noexcept {
    return count_ > 0 ? waiting_[first_].due : std::numeric_limits<double>::infinity();
  }
  /// Forgets every command: no torque until a new one is due.
  void clear() noexcept {
    count_ = 0;
    acting_Nm_ = 0.0;
  }

 private:
  struct Command {
    double due = 0.0;
    double torque_Nm = 0.0;
  };
  const Command& newest() const noexcept { return waiting_[(first_ + count_ - 1) % waiting_.size()]; }
  void drop_oldest() noexcept {
    acting_Nm_ = waiting_[first_].torque_Nm;
    first_ = (first_ + 1) % waiting_.size();
    --count_;
  }

  DelayConfig config_;
  std::mt19937_64 random_;
  std::array<Command, 32> waiting_{};
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  double acting_Nm_ = 0.0;
};

}  // namespace strainwave
