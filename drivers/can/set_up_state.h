// SPDX-License-Identifier: BSD-3-Clause
// How far the set-up of a drive is, between the background thread, which does it, and the loop, which asks for it and uses
// the drive only when it is done. What set-up writes may be read by the loop once ready(), and by no other thread meanwhile.
// Real-time safe.
//
// As the loop sees it:
//
//   Away ------ set up ---------------------------> Settling   the frames that this period finds may be of the time before
//   Settling -- the next period ------------------> Ready      whatever was known of the drive is forgotten
//   Ready ----- wear_out() -----------------------> WornOut    in use still; after a fault not without a new set-up
//   any ------- request(), a set-up that begins --> Away
//   any ------- a set-up that failed -------------> Failed
#pragma once

#include <atomic>

namespace strainwave {

class SetUpState {
 public:
  enum class State : int { kReady, kRequested, kRunning, kFailed };

  // Start-up and the background thread.

  /// Takes the loop's request, if there is one; then a set-up must follow, and end().
  bool begin() noexcept {
    State requested = State::kRequested;
    return state_.compare_exchange_strong(requested, State::kRunning, std::memory_order_acq_rel);
  }
  void end(bool good) noexcept {
    state_.store(good ? State::kReady : State::kFailed, std::memory_order_release);
  }

  // Either.

  State now() const noexcept { return state_.load(std::memory_order_acquire); }

  // The loop.

  /// At the begin of a period. True: from this one on the drive can be used, and begins anew.
  bool look() noexcept {
    const State state = now();
    if (state != State::kReady) {
      seen_ = state == State::kFailed ? Seen::kFailed : Seen::kAway;
      return false;
    }
    if (ready()) return false;
    const bool settled = seen_ == Seen::kSettling;
    seen_ = settled ? Seen::kReady : Seen::kSettling;
    return settled;
  }
  bool ready() const noexcept { return seen_ == Seen::kReady || seen_ == Seen::kWornOut; }
  bool failed() const noexcept { return seen_ == Seen::kFailed; }
  /// What set-up found may no longer be so: the drive was out of sight, or measured lateness has changed.
  void wear_out() noexcept {
    if (seen_ == Seen::kReady) seen_ = Seen::kWornOut;
  }
  /// A fault cannot be cleared without a new set-up.
  bool must_be_repeated() const noexcept { return seen_ == Seen::kWornOut || seen_ == Seen::kFailed; }
  /// The drive is not used any more until it has been set up anew.
  void request() noexcept {
    seen_ = Seen::kAway;
    state_.store(State::kRequested, std::memory_order_release);
  }

 private:
  enum class Seen : int { kAway, kSettling, kReady, kWornOut, kFailed };

  std::atomic<State> state_{State::kRequested};
  Seen seen_ = Seen::kAway;
};

}  // namespace strainwave
