// The order of amplifier and brake: a state machine that is told what is wanted and says what the outputs
// are. Pure, real-time safe; time is an argument.
//
//   off --enable--> amplifier on, no torque, brake shut --enable_delay--> brake opens --release_delay--> on
//   on --disable--> brake shuts while the last torque holds the load --engage_delay--> off
//   any --stop--> no torque, amplifier off at once; the brake shuts after stop_delay, when friction has
//   slowed the joint
// Without a brake its delays are 0.
#pragma once

#include <cstdint>

#include "drivers/actuator.h"

namespace strainwave {

struct DriveSequenceConfig {
  double enable_delay_s = 0.0;   ///< the amplifier needs this before it makes torque
  double release_delay_s = 0.0;  ///< the brake needs this to open
  double engage_delay_s = 0.0;   ///< the brake needs this to shut
  double stop_delay_s = 0.0;     ///< after a stop, until the brake shuts
};

class DriveSequence {
 public:
  enum class State { kOff, kEnabling, kReleasing, kOn, kEngaging, kStopping };
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
  bool on() const noexcept { return state_ == State::kOn; }
  /// The last torque is kept while the brake shuts.
  bool holds_torque() const noexcept { return state_ == State::kEngaging; }
  /// The amplifier has had its time to become ready.
  bool amplifier_ready() const noexcept { return state_ == State::kReleasing || on() || holds_torque(); }
  DriveState drive_state() const noexcept;

 private:
  void enter(State state, std::int64_t now_ns) noexcept;
  Outputs outputs() const noexcept;

  std::int64_t enable_delay_ns_;
  std::int64_t release_delay_ns_;
  std::int64_t engage_delay_ns_;
  std::int64_t stop_delay_ns_;
  State state_ = State::kOff;
  std::int64_t since_ns_ = 0;
};

}  // namespace strainwave
