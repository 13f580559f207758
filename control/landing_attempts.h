// How often a landing may be tried: one that does not come off is given up, tried again after a pause, and
// after so many failures in a row no more until the next start. Real-time safe.
//
//   Open ------ too many periods, or begun too often ------> Paused      (a failure)
//   Paused ---- the pause is over, or a new target --------> Open
//   any ------- the third failure in a row ----------------> Exhausted
//   any ------- landed ------------------------------------> Open        (failures forgotten)
#pragma once

namespace strainwave {

class LandingAttempts {
 public:
  enum class State { kOpen, kPaused, kExhausted };

  // A landing takes some 100 periods. One that takes this many, or has to begin this often, does not come off:
  // the delay or the encoder are not what the configuration says.
  static constexpr int kPeriods = 400;
  static constexpr int kBegins = 6;
  static constexpr int kFailures = 3;
  static constexpr int kPausePeriods = 500;

  State state() const noexcept { return state_; }
  bool allowed() const noexcept { return state_ == State::kOpen; }

  /// A new start: nothing has been tried.
  void reset() noexcept { *this = {}; }
  /// A new target: what was tried on the last one no longer counts, but failures in a row do.
  void new_target() noexcept;
  /// A landing begins.
  void begin() noexcept;
  /// A period of it.
  void spend_period() noexcept;
  /// It came off.
  void landed() noexcept { reset(); }
  /// A period at the target in which a landing would have been wanted and is not allowed.
  void wait() noexcept;

 private:
  void fail() noexcept;

  State state_ = State::kOpen;
  int periods_ = 0;
  int begins_ = 0;
  int pause_periods_ = 0;
  int failures_ = 0;  ///< in a row
};

}  // namespace strainwave
