// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/gpio/drive_sequence.h"

#include <cmath>

#include "base/durations.h"

namespace strainwave {

DriveSequence::DriveSequence(const DriveSequenceConfig& config) noexcept
    : enable_delay_ns_(nanoseconds(config.enable_delay_s)),
      hold_delay_ns_(nanoseconds(config.hold_delay_s)),
      release_delay_ns_(nanoseconds(config.release_delay_s)),
      engage_delay_ns_(nanoseconds(config.engage_delay_s)),
      stop_delay_ns_(nanoseconds(config.stop_delay_s)) {}

void DriveSequence::enter(State state, std::int64_t now_ns) noexcept {
  state_ = state;
  since_ns_ = now_ns;
}

DriveSequence::Outputs DriveSequence::outputs() const noexcept {
  switch (state_) {
    case State::kOff:
      return {false, false};
    case State::kEnabling:
    case State::kHolding:
      return {true, false};
    case State::kReleasing:
    case State::kOn:
      return {true, true};
    case State::kEngaging:
      return {true, false};
    case State::kStopping:
      return {false, true};
  }
  return {false, false};
}

DriveSequence::Outputs DriveSequence::step(bool enable, std::int64_t now_ns) noexcept {
  const std::int64_t elapsed_ns = now_ns - since_ns_;
  switch (state_) {
    case State::kOff:
      if (enable) enter(State::kEnabling, now_ns);
      break;
    case State::kEnabling:
      if (!enable)
        enter(State::kOff, now_ns);
      else if (elapsed_ns >= enable_delay_ns_)
        enter(State::kHolding, now_ns);
      break;
    case State::kHolding:
      if (!enable)
        enter(State::kEngaging, now_ns);
      else if (elapsed_ns >= hold_delay_ns_)
        enter(State::kReleasing, now_ns);
      break;
    case State::kReleasing:
      if (!enable)
        enter(State::kEngaging, now_ns);
      else if (elapsed_ns >= release_delay_ns_)
        enter(State::kOn, now_ns);
      break;
    case State::kOn:
      if (!enable) enter(State::kEngaging, now_ns);
      break;
    case State::kEngaging:
      // An order to enable again waits until the brake is shut.
      if (elapsed_ns >= engage_delay_ns_) enter(State::kOff, now_ns);
      break;
    case State::kStopping:
      if (elapsed_ns >= stop_delay_ns_) enter(State::kOff, now_ns);
      break;
  }
  return outputs();
}

DriveSequence::Outputs DriveSequence::stop(std::int64_t now_ns) noexcept {
  const bool brake_open = outputs().brake_open;
  if (brake_open && state_ != State::kStopping)
    enter(State::kStopping, now_ns);
  else if (!brake_open)
    enter(State::kOff, now_ns);
  if (state_ == State::kStopping && now_ns - since_ns_ >= stop_delay_ns_) enter(State::kOff, now_ns);
  return outputs();
}

DriveState DriveSequence::drive_state() const noexcept {
  switch (state_) {
    case State::kOff:
    // The amplifier is off; the loop need not know that the brake is still open.
    case State::kStopping:
      return DriveState::kDisabled;
    case State::kEnabling:
    // A new order to enable waits until the brake is shut.
    case State::kEngaging:
      return DriveState::kEnabling;
    case State::kHolding:
    case State::kReleasing:
    case State::kOn:
      return DriveState::kEnabled;
  }
  return DriveState::kFault;
}

}  // namespace strainwave
