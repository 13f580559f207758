// SPDX-License-Identifier: BSD-3-Clause
// The order of amplifier and brake: a state machine from what is wanted to what the outputs
// are. Pure, real-time safe; time is an argument.
//
//   off --enable--> amplifier on, no torque, brake shut
//     --enable_delay--> torque, brake shut: whoever controls the joint takes hold of it
//     --hold_delay--> brake opens, under torque --release_delay--> on: the joint may be moved
//   on --disable--> brake shuts while the last torque holds the load --engage_delay--> off
//   any --stop--> no torque, amplifier off, brake shut, all at once; with stop_delay the brake shuts so much
//   later, for a joint that friction shall slow first and no load drives
// Without a brake its delays are 0.
#pragma once

#include <cstdint>

#include "drivers/actuator.h"

namespace strainwave {

struct DriveSequenceConfig {
  double enable_delay_s = 0.0;   ///< the amplifier needs this before it makes torque
  double hold_delay_s = 0.0;     ///< under torque with the brake shut, before it opens
  double release_delay_s = 0.0;  ///< the brake needs this to open
  double engage_delay_s = 0.0;   ///< the brake needs this to shut
  double stop_delay_s = 0.0;     ///< after a stop, until the brake shuts
};

class DriveSequence {
 public:
  enum class State { kOff, kEnabling, kHolding, kReleasing, kOn, kEngaging, kStopping };
  struct Outputs {
    bool enable = false;
    bool brake_open = false;
  };

  explicit DriveSequence(const DriveSequenceConfig& config) noexcept;

  /// One period.
  Outputs step(bool enable, std::int64_t now_ns) noexcept;
  /// At once; step() then shuts the brake in time.
  Outputs stop(std::int64_t now_ns) noexcept;

  State state() const noexcept { return state_; }
  /// Torque orders take effect.
  bool has_torque() const noexcept {
    return state_ == State::kHolding || state_ == State::kReleasing || state_ == State::kOn;
  }
  /// The brake has opened, and the joint may be moved.
  bool may_move() const noexcept { return state_ == State::kOn; }
  /// The last torque is kept while the brake shuts.
  bool holds_torque() const noexcept { return state_ == State::kEngaging; }
  /// The amplifier has had its time to become ready.
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
