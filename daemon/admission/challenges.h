// What an order must quote to be obeyed: a random number from the daemon's state that is not older than an order may become. It
// cannot be known before it is published, so that an order which somebody keeps back is worthless soon after, whatever clocks and
// states that somebody forges. A stop or a fault of a joint ends all that were drawn until then for that joint: what was sent before a stop is
// not obeyed after it, whichever of the two came first. Time is the loop's own count of periods. Not real-time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace strainwave {

class Challenges {
 public:
  /// So many are drawn in the lifetime of one.
  static constexpr std::int64_t kPerLifetime = 8;

  /// After a stop the next is drawn sooner, but not so many times that those of a lifetime are forgotten.
  static constexpr std::int64_t kMostPerLifetime = 100;

  Challenges(std::int64_t lifetime_cycles, std::size_t joints)
      : step_cycles_(std::max<std::int64_t>(1, lifetime_cycles / kPerLifetime)),
        least_step_cycles_(std::max<std::int64_t>(1, lifetime_cycles / kMostPerLifetime)),
        stops_(joints),
        stop_counts_(joints) {}

  /// How long one is good at most, from when it is drawn.
  std::int64_t lifetime_cycles() const noexcept { return step_cycles_ * (kPerLifetime + 1); }

  /// It is `cycle` now: takes `random` as the new challenge when one is due. Returns the present one, never 0.
  std::int64_t advance(std::int64_t cycle, std::int64_t random) noexcept {
    cycle_ = std::max(cycle_, cycle);
    const std::int64_t due_cycles = due_soon_ ? least_step_cycles_ : step_cycles_;
    if (drawn_[newest_].challenge == 0 || cycle_ - drawn_[newest_].cycle >= due_cycles) {
      newest_ = (newest_ + 1) % drawn_.size();
      drawn_[newest_] = {std::max<std::int64_t>(1, random & INT64_MAX), cycle_, ++draws_};
      due_soon_ = false;
    }
    return drawn_[newest_].challenge;
  }

  /// `joint` is stopped now, by an order or a fault.
  void stop(std::size_t joint) noexcept {
    stops_[joint] = draws_;
    ++stop_counts_[joint];
    due_soon_ = true;
  }

  /// The cycle beyond which an order that quotes `challenge` is too old; negative when it is so already, or was never drawn.
  std::int64_t expiry_cycle(std::int64_t challenge) const noexcept {
    const Drawn* drawn = find(challenge);
    return drawn == nullptr ? -1 : drawn->cycle + lifetime_cycles();
  }
  /// Whether `joint` was stopped since `challenge`, which has not expired, was new.
  bool stopped_since(std::int64_t challenge, std::size_t joint) const noexcept {
    const Drawn* drawn = find(challenge);
    return drawn != nullptr && drawn->number <= stops_[joint];
  }
  /// How often `joint` was stopped: the same number later means that it was not meanwhile.
  std::int64_t stop_count(std::size_t joint) const noexcept { return stop_counts_[joint]; }
  std::int64_t cycle() const noexcept { return cycle_; }

 private:
  struct Drawn {
    std::int64_t challenge = 0;
    std::int64_t cycle = 0;
    std::int64_t number = 0;
  };
  const Drawn* find(std::int64_t challenge) const noexcept {
    for (const Drawn& drawn : drawn_) {
      if (challenge != 0 && drawn.challenge == challenge && cycle_ <= drawn.cycle + lifetime_cycles())
        return &drawn;
    }
    return nullptr;
  }

  std::int64_t step_cycles_;
  std::int64_t least_step_cycles_;
  std::int64_t cycle_ = 0;
  std::int64_t draws_ = 0;
  std::vector<std::int64_t> stops_;  ///< of each joint: draws_ when it was stopped last
  std::vector<std::int64_t> stop_counts_;
  bool due_soon_ = false;
  std::array<Drawn, kMostPerLifetime + kPerLifetime + 16> drawn_{};
  std::size_t newest_ = 0;
};

}  // namespace strainwave
