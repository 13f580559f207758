// SPDX-License-Identifier: BSD-3-Clause
// The state of a drive's set-up. The background thread does the set-up; the loop requests it and uses the
// drive only when it is done. The loop may read the data that set-up writes once ready(); no other thread may
// read them meanwhile. Real-time safe.
//
// As the loop sees it:
//
//   Away ------ set up ---------------------------> Settling   frames received in this period may predate the set-up
//   Settling -- the next period ------------------> Ready      the loop discards its old state of the drive
//   Ready ----- wear_out() -----------------------> WornOut    still in use; a fault then needs a new set-up
//   any ------- request(), a set-up that begins --> Away
//   any ------- a set-up that failed -------------> Failed
#pragma once

#include <atomic>

namespace strainwave {

class SetUpState {
 public:
  enum class State : int { kReady, kRequested, kRunning, kFailed };

  // For start-up and the background thread.

  /// Takes the loop's request, if there is one. The caller must then do a set-up and call end().
  bool begin() noexcept {
    State requested = State::kRequested;
    return state_.compare_exchange_strong(requested, State::kRunning, std::memory_order_acq_rel);
  }
  void end(bool good) noexcept {
    state_.store(good ? State::kReady : State::kFailed, std::memory_order_release);
  }

  // For both.

  State now() const noexcept { return state_.load(std::memory_order_acquire); }

  // For the loop.

  /// Called at the start of each period. True: from this period on the drive can be used, and its old state must be forgotten.
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
  /// The results of set-up may be outdated: the drive was unreachable, or its measured delay has changed.
  void wear_out() noexcept {
    if (seen_ == Seen::kReady) seen_ = Seen::kWornOut;
  }
  /// A fault can be cleared only with a new set-up.
  bool must_be_repeated() const noexcept { return seen_ == Seen::kWornOut || seen_ == Seen::kFailed; }
  /// The drive must not be used until it has been set up again.
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
