// What an order must quote to be obeyed: a random number from the daemon's state that is not older than an order may become. It
// cannot be known before it is published, so that an order which somebody keeps back is worthless soon after, whatever clocks and
// states that somebody forges. Time is the loop's own count of periods. Not real-time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

namespace strainwave {

class Challenges {
 public:
  /// So many are drawn in the lifetime of one.
  static constexpr std::int64_t kPerLifetime = 8;

  explicit Challenges(std::int64_t lifetime_cycles)
      : step_cycles_(std::max<std::int64_t>(1, lifetime_cycles / kPerLifetime)) {}

  /// How long one is good at most, from when it is drawn.
  std::int64_t lifetime_cycles() const noexcept { return step_cycles_ * (kPerLifetime + 1); }

  /// It is `cycle` now: takes `random` as the new challenge when one is due. Returns the present one, never 0.
  std::int64_t advance(std::int64_t cycle, std::int64_t random) noexcept {
    cycle_ = std::max(cycle_, cycle);
    if (drawn_[newest_].challenge == 0 || cycle_ - drawn_[newest_].cycle >= step_cycles_) {
      newest_ = (newest_ + 1) % drawn_.size();
      drawn_[newest_] = {std::max<std::int64_t>(1, random & INT64_MAX), cycle_};
    }
    return drawn_[newest_].challenge;
  }

  /// The cycle beyond which an order that quotes `challenge` is too old; negative when it is so already, or was never drawn.
  std::int64_t expiry_cycle(std::int64_t challenge) const noexcept {
    for (const Drawn& drawn : drawn_) {
      const std::int64_t expiry = drawn.cycle + lifetime_cycles();
      if (challenge != 0 && drawn.challenge == challenge && cycle_ <= expiry) return expiry;
    }
    return -1;
  }
  std::int64_t cycle() const noexcept { return cycle_; }

 private:
  struct Drawn {
    std::int64_t challenge = 0;
    std::int64_t cycle = 0;
  };
  std::int64_t step_cycles_;
  std::int64_t cycle_ = 0;
  std::array<Drawn, kPerLifetime + 2> drawn_{};
  std::size_t newest_ = 0;
};

}  // namespace strainwave
