// SPDX-License-Identifier: BSD-3-Clause
// The switching sequence of amplifier and brake: a state machine from the enable order to the outputs. Pure,
// real-time safe; time is an argument.
//
//   off --enable--> amplifier on, no torque, brake shut
//     --enable_delay--> torque, brake shut: the controller takes over the load
//     --hold_delay--> brake opens, under torque --release_delay--> on: the joint may be moved
//   on --disable--> brake shuts while the last torque holds the load --engage_delay--> off
//   any --stop--> no torque, amplifier off, brake shut, all at once. With stop_delay the brake shuts
//   later, for a joint without a driving load that friction shall slow first
// Without a brake, its delays are 0.
#pragma once

#include <cstdint>

#include "drivers/actuator.h"

namespace strainwave {

struct DriveSequenceConfig {
  double enable_delay_s = 0.0;   ///< time until the amplifier can produce torque
  double hold_delay_s = 0.0;     ///< under torque with the brake shut, before the brake opens
  double release_delay_s = 0.0;  ///< time that the brake needs to open
  double engage_delay_s = 0.0;   ///< time that the brake needs to shut
  double stop_delay_s = 0.0;     ///< from a stop until the brake shuts
};

class DriveSequence {
 public:
  enum class State { kOff, kEnabling, kHolding, kReleasing, kOn, kEngaging, kStopping };
  struct Outputs {
    bool enable = false;
    bool brake_open = false;
  };

  explicit DriveSequence(const DriveSequenceConfig& config) noexcept;

  /// Advances by one period.
  Outputs step(bool enable, std::int64_t now_ns) noexcept;
  /// Stops at once; step() later shuts the brake when stop_delay_s is over.
  Outputs stop(std::int64_t now_ns) noexcept;

  State state() const noexcept { return state_; }
  /// Torque orders take effect.
  bool has_torque() const noexcept {
    return state_ == State::kHolding || state_ == State::kReleasing || state_ == State::kOn;
  }
  /// The brake has opened, and the joint may be moved.
  bool may_move() const noexcept { return state_ == State::kOn; }
  /// The output keeps the last torque while the brake shuts.
  bool holds_torque() const noexcept { return state_ == State::kEngaging; }
  /// The enable delay of the amplifier is over.
  bool amplifier_ready() const noexcept { return has_torque() || holds_torque(); }
  DriveState drive_state() const noexcept;

 private:
  void enter(State state, std::int64_t now_ns) noexcept;
  Outputs outputs() const noexcept;

  std::int64_t enable_delay_ns_;
  std::int64_t hold_delay_ns_;
  std::int64_t release_delay_ns_;
  std::int64_t engage_delay_ns_;
  std::int64_t stop_delay_ns_;
  State state_ = State::kOff;
  std::int64_t since_ns_ = 0;
};

}  // namespace strainwave
