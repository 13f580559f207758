#include "control/landing_attempts.h"

namespace strainwave {

void LandingAttempts::new_target() noexcept {
  periods_ = 0;
  begins_ = 0;
  pause_periods_ = 0;
  state_ = failures_ < kFailures ? State::kOpen : State::kExhausted;
}

void LandingAttempts::begin() noexcept {
  if (++begins_ > kBegins) fail();
}

void LandingAttempts::spend_period() noexcept {
  if (++periods_ == kPeriods) fail();
}

void LandingAttempts::wait() noexcept {
  if (state_ == State::kPaused && ++pause_periods_ >= kPausePeriods) new_target();
}

void LandingAttempts::fail() noexcept {
  ++failures_;
  state_ = failures_ < kFailures ? State::kPaused : State::kExhausted;
}

}  // namespace strainwave
