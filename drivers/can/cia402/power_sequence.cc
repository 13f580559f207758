// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/can/cia402/power_sequence.h"

#include <algorithm>

namespace strainwave::cia402 {

namespace {

/// Periods in which the reset bit stays low, then high. Several, because a frame may be lost and the rising edge counts.
constexpr int kResetHalf = 5;

}  // namespace

void PowerSequence::see(std::uint16_t statusword, std::int64_t now_ns) noexcept {
  if (power_state_of(statusword) != state()) step_since_ns_ = now_ns;
  statusword_ = statusword;
  if (goal_ == Goal::kEnabled && state() == PowerState::kOperationEnabled) reached_ = true;
  if (resetting_ && (state() != PowerState::kFault || now_ns - reset_since_ns_ > times_.reset_ns)) {
    // The time of the reset does not count for the next step.
    step_since_ns_ = now_ns;
    resetting_ = false;
  }
}

std::uint16_t PowerSequence::controlword(Goal goal, std::int64_t now_ns) noexcept {
  if (goal != goal_) {
    goal_ = goal;
    goal_since_ns_ = step_since_ns_ = now_ns;
    reached_ = goal == Goal::kEnabled && state() == PowerState::kOperationEnabled;
  }
  if (resetting_ && goal != Goal::kQuickStop) return reset_word();
  if (goal_ == Goal::kQuickStop && now_ns - goal_since_ns_ > times_.quick_stop_ns)
    return controlword::kDisableVoltage;
  return controlword_towards(goal_, state());
}

std::uint16_t PowerSequence::reset_word() noexcept {
  const bool high = (reset_periods_++ / kResetHalf) % 2 != 0;
  return high ? controlword::kFaultReset : controlword::kDisableVoltage;
}

void PowerSequence::begin_reset(std::int64_t now_ns) noexcept {
  resetting_ = true;
  reset_since_ns_ = now_ns;
  reset_periods_ = 0;
}

bool PowerSequence::stuck(std::int64_t now_ns) const noexcept {
  return goal_ == Goal::kEnabled && !resetting_ && state() != PowerState::kOperationEnabled &&
         now_ns - std::max(step_since_ns_, goal_since_ns_) > times_.step_ns;
}

}  // namespace strainwave::cia402
