// How far the set-up of a drive is, between the background thread, which does it, and the loop, which asks for it and uses
// the drive only when it is done. What set-up writes may be read by the loop once it has seen kReady, and by nobody else
// meanwhile. Real-time safe.
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

  void see(State state) noexcept { seen_ = state; }
  bool ready() const noexcept { return seen_ == State::kReady; }
  bool failed() const noexcept { return seen_ == State::kFailed; }
  /// The drive is not used any more until it has been set up anew.
  void request() noexcept {
    seen_ = State::kRequested;
    state_.store(State::kRequested, std::memory_order_release);
  }

 private:
  std::atomic<State> state_{State::kRequested};
  State seen_ = State::kRequested;  ///< by the loop
};

}  // namespace strainwave
