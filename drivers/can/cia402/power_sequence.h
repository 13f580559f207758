// SPDX-License-Identifier: BSD-3-Clause
// A drive's power state over time: leads it to a goal, supervises the time of every step, and resets a fault
// by a rising edge. Real-time safe; time is an argument. Source: CiA 402-2, section 6.
#pragma once

#include <cstdint>

#include "drivers/can/cia402/cia402_state.h"

namespace strainwave::cia402 {

struct PowerTimes {
  std::int64_t step_ns = 500'000'000;          ///< for each step of enabling
  std::int64_t quick_stop_ns = 1'000'000'000;  ///< after this time the voltage is ordered off
  std::int64_t reset_ns = 1'000'000'000;       ///< time for the drive to leave its fault
};

class PowerSequence {
 public:
  explicit PowerSequence(const PowerTimes& times) noexcept : times_(times) {}

  /// Takes a new statusword.
  void see(std::uint16_t statusword, std::int64_t now_ns) noexcept;
  /// Returns the controlword of this period on the way to `goal`.
  std::uint16_t controlword(Goal goal, std::int64_t now_ns) noexcept;
  /// Resets the drive's fault, if there is one. Called only on an operator's order.
  void begin_reset(std::int64_t now_ns) noexcept;

  PowerState state() const noexcept { return power_state_of(statusword_); }
  std::uint16_t statusword() const noexcept { return statusword_; }
  bool in_fault() const noexcept {
    return state() == PowerState::kFault || state() == PowerState::kFaultReaction;
  }
  bool has_torque() const noexcept {
    return state() == PowerState::kOperationEnabled || state() == PowerState::kQuickStopActive;
  }
  bool resetting() const noexcept { return resetting_; }
  /// Enabling has stayed too long in one state.
  bool stuck(std::int64_t now_ns) const noexcept;
  /// The drive reached operation enabled under the goal kEnabled and has left it by itself.
  bool left_operation() const noexcept {
    return goal_ == Goal::kEnabled && reached_ && state() != PowerState::kOperationEnabled;
  }
  /// Resets all state after a new set-up of the drive.
  void restart() noexcept { *this = PowerSequence(times_); }

 private:
  std::uint16_t reset_word() noexcept;

  PowerTimes times_;
  std::uint16_t statusword_ = 0;
  Goal goal_ = Goal::kDisabled;
  std::int64_t goal_since_ns_ = 0;
  std::int64_t step_since_ns_ = 0;
  std::int64_t reset_since_ns_ = 0;
  int reset_periods_ = 0;
  bool reached_ = false;
  bool resetting_ = false;
};

}  // namespace strainwave::cia402
