// SPDX-License-Identifier: BSD-3-Clause
// What an order must quote to be obeyed: a random number from the daemon's state that is not older than an order may become. It
// cannot be known before it is published. So an order that an attacker delays is soon worthless, whatever clocks and states are forged.
// A stop or a fault of a joint ends all that were drawn until then for that joint: an order that was sent before a stop is not obeyed after
// it, whichever came first. The sender may repeat its order after its own stop, but not after that of another. Time is
// the loop's own count of periods. Not real-time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace strainwave {

/// A message by its sender and its place among his: an order, or a stop. Programs of one account have one sender_id, whatever their keys.
struct Sent {
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  std::int64_t key = -1;  ///< of the key that signed; -1: none, or not proved

  bool of_the_sender_of(const Sent& other) const noexcept {
    return sender_id == other.sender_id && key == other.key;
  }
};

/// What has become of a joint since an order's challenge was new.
enum class Since {
  kNothing,
  kOwnStop,  ///< its sender stopped it before it gave the order, or it has faulted: the order may be repeated
  kOthersStop,  ///< another stopped it, or its sender did after it gave the order: it is overtaken
};

class Challenges {
 public:
  /// So many are drawn in the lifetime of one.
  static constexpr std::int64_t kPerLifetime = 8;

  /// After a stop the next is drawn at once, after more stops than this in a lifetime not so many times that those of a lifetime are
  /// forgotten.
  static constexpr std::int64_t kAtOncePerLifetime = 1024;
  static constexpr std::int64_t kMostPerLifetime = 100;

  Challenges(std::int64_t lifetime_cycles, std::size_t joints)
      : step_cycles_(std::max<std::int64_t>(1, lifetime_cycles / kPerLifetime)),
        least_step_cycles_((lifetime_cycles + kMostPerLifetime - 1) / kMostPerLifetime),
        joints_(joints) {}

  /// How long one is good at most, from when it is drawn.
  std::int64_t lifetime_cycles() const noexcept { return step_cycles_ * (kPerLifetime + 1); }

  /// It is `cycle` now: takes `random` as the new challenge when one is due. Returns the present one, never 0.
  std::int64_t advance(std::int64_t cycle, std::int64_t random) noexcept {
    cycle_ = std::max(cycle_, cycle);
    if (is_due()) {
      newest_ = (newest_ + 1) % drawn_.size();
      drawn_[newest_] = {std::max<std::int64_t>(1, random & INT64_MAX), cycle_, ++draws_};
      due_soon_ = false;
    }
    return drawn_[newest_].challenge;
  }

  /// `joint` is stopped now, by that message.
  void stop(std::size_t joint, const Sent& stop) noexcept {
    JointStops& stops = joints_[joint];
    if (!stops.last.of_the_sender_of(stop)) stops.others = stops.sent;
    stops.last = stop;
    stops.sent = draws_;
    end_all(stops);
  }
  /// `joint` has faulted in `cycle`. What is drawn in that cycle may be from before it.
  void fault(std::size_t joint, std::int64_t cycle) noexcept {
    faulted_cycle_ = std::max(faulted_cycle_, cycle);
    end_all(joints_[joint]);
  }

  /// The cycle beyond which an order that quotes `challenge` is too old; negative when it is so already, or was never drawn.
  std::int64_t expiry_cycle(std::int64_t challenge) const noexcept {
    const Drawn* drawn = find(challenge);
    return drawn == nullptr ? -1 : drawn->cycle + lifetime_cycles();
  }
  /// In which cycle it was drawn, -1: it was not, or has expired.
  std::int64_t drawn_cycle(std::int64_t challenge) const noexcept {
    const Drawn* drawn = find(challenge);
    return drawn == nullptr ? -1 : drawn->cycle;
  }
  /// What became of `joint` since `challenge`, which has not expired and is quoted by `order`, was new.
  Since since(std::int64_t challenge, std::size_t joint, const Sent& order) const noexcept {
    const Drawn* drawn = find(challenge);
    const JointStops& stops = joints_[joint];
    if (drawn == nullptr || drawn->number > stops.any) return Since::kNothing;
    const bool of_sender = stops.last.of_the_sender_of(order);
    const bool of_own = of_sender && stops.last.sequence < order.sequence;
    const bool overtaken =
        (drawn->number <= stops.sent && !of_own) || (drawn->number <= stops.others && of_sender);
    return overtaken ? Since::kOthersStop : Since::kOwnStop;
  }
  /// How often `joint` was stopped: the same number later means that it was not meanwhile.
  std::int64_t stop_count(std::size_t joint) const noexcept { return joints_[joint].count; }
  std::int64_t cycle() const noexcept { return cycle_; }

 private:
  struct Drawn {
    std::int64_t challenge = 0;
    std::int64_t cycle = 0;
    std::int64_t number = 0;
  };
  /// What ended challenges of a joint. Numbers are those of draws: what has them, or less, is from before.
  struct JointStops {
    std::int64_t any = 0;     ///< the last stop or fault
    std::int64_t sent = 0;    ///< the last stop, `last`
    std::int64_t others = 0;  ///< the last stop of another sender than that
    Sent last;
    std::int64_t count = 0;
  };
  void end_all(JointStops& stops) noexcept {
    stops.any = draws_;
    ++stops.count;
    due_soon_ = true;
  }
  bool is_due() const noexcept {
    const std::int64_t age_cycles = cycle_ - drawn_[newest_].cycle;
    if (drawn_[newest_].challenge == 0) return true;
    if (cycle_ <= faulted_cycle_) return false;
    if (!due_soon_ || age_cycles >= step_cycles_) return age_cycles >= step_cycles_;
    const Drawn& long_ago = drawn_[(newest_ + drawn_.size() - kAtOncePerLifetime) % drawn_.size()];
    return age_cycles >= least_step_cycles_ || long_ago.challenge == 0 || is_over(long_ago);
  }
  bool is_over(const Drawn& drawn) const noexcept { return cycle_ > drawn.cycle + lifetime_cycles(); }
  const Drawn* find(std::int64_t challenge) const noexcept {
    for (const Drawn& drawn : drawn_) {
      if (challenge != 0 && drawn.challenge == challenge && !is_over(drawn)) return &drawn;
    }
    return nullptr;
  }

  std::int64_t step_cycles_;
  std::int64_t least_step_cycles_;
  std::int64_t cycle_ = 0;
  std::int64_t draws_ = 0;
  std::vector<JointStops> joints_;
  std::int64_t faulted_cycle_ = -1;  ///< the last in which any joint has
  bool due_soon_ = false;
  // As many as can be drawn in the nine eighths of a lifetime that one is good for.
  std::array<Drawn, kAtOncePerLifetime + 2 * kMostPerLifetime> drawn_{};
  std::size_t newest_ = 0;
};

}  // namespace strainwave
