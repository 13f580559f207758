// SPDX-License-Identifier: BSD-3-Clause
// Challenges: random numbers in the daemon's state. An order must quote one that is younger than the order lifetime. A challenge is
// unknown before it is published, so a delayed order soon becomes worthless, whatever clocks and states an attacker forges.
// A stop or fault of a joint invalidates the joint's earlier challenges. After a stop the daemon thus obeys no order that was sent
// before it, whichever arrived first. A sender may repeat its order after its own stop, but not after that of another. Time is the
// loop's count of periods. Not real-time.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace strainwave {

/// Identifies an order or a stop by sender and sequence. Programs of one account share a sender_id, whatever their keys.
struct Sent {
  std::int64_t sender_id = 0;
  std::int64_t sequence = 0;
  std::int64_t key = -1;  ///< index of the signing key, of an order as claimed; -1: none, or not verified

  bool of_the_sender_of(const Sent& other) const noexcept {
    return sender_id == other.sender_id && key == other.key;
  }
};

/// How a joint was stopped since the draw of an order's challenge.
enum class Since {
  kNothing,
  kOwnStop,     ///< the sender stopped it before giving the order, or it faulted: the order may be repeated
  kOthersStop,  ///< another sender stopped it, or the same one after giving the order: the order is superseded
};

class Challenges {
 public:
  /// Challenges drawn in a lifetime without stops.
  static constexpr std::int64_t kPerLifetime = 8;

  /// After a stop or fault the next challenge is drawn at once, up to kAtOncePerLifetime times in a lifetime. Beyond this, at most
  /// kMostPerLifetime are drawn in a lifetime, so that the buffer never loses a valid challenge.
  static constexpr std::int64_t kAtOncePerLifetime = 1024;
  static constexpr std::int64_t kMostPerLifetime = 100;

  Challenges(std::int64_t lifetime_cycles, std::size_t joints)
      : step_cycles_(std::max<std::int64_t>(1, lifetime_cycles / kPerLifetime)),
        least_step_cycles_((lifetime_cycles + kMostPerLifetime - 1) / kMostPerLifetime),
        joints_(joints) {}

  /// Longest validity of a challenge, from its draw.
  std::int64_t lifetime_cycles() const noexcept { return step_cycles_ * (kPerLifetime + 1); }

  /// Sets the present cycle; takes `random` as the new challenge when one is due. Returns the present challenge, never 0.
  std::int64_t advance(std::int64_t cycle, std::int64_t random) noexcept {
    cycle_ = std::max(cycle_, cycle);
    if (is_due()) {
      newest_ = (newest_ + 1) % drawn_.size();
      drawn_[newest_] = {std::max<std::int64_t>(1, random & INT64_MAX), cycle_, ++draws_};
      due_soon_ = false;
    }
    return drawn_[newest_].challenge;
  }

  /// The message `stop` stops `joint` now.
  void stop(std::size_t joint, const Sent& stop) noexcept {
    JointStops& stops = joints_[joint];
    if (!stops.last.of_the_sender_of(stop)) stops.others = stops.sent;
    stops.last = stop;
    stops.sent = draws_;
    end_all(stops);
  }
  /// `joint` faulted in `cycle`. The next challenge is drawn in a later cycle, since one of this cycle could precede the fault.
  void fault(std::size_t joint, std::int64_t cycle) noexcept {
    faulted_cycle_ = std::max(faulted_cycle_, cycle);
    end_all(joints_[joint]);
  }

  /// The last cycle in which an order may quote `challenge`; negative if it has expired or was never drawn.
  std::int64_t expiry_cycle(std::int64_t challenge) const noexcept {
    const Drawn* drawn = find(challenge);
    return drawn == nullptr ? -1 : drawn->cycle + lifetime_cycles();
  }
  /// The cycle in which `challenge` was drawn; -1 if it has expired or was never drawn.
  std::int64_t drawn_cycle(std::int64_t challenge) const noexcept {
    const Drawn* drawn = find(challenge);
    return drawn == nullptr ? -1 : drawn->cycle;
  }
  /// How `joint` was stopped since the draw of `challenge`, which `order` quotes and which has not expired.
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
  /// Number of stops and faults of `joint`. An equal number later means that there was none in between.
  std::int64_t stop_count(std::size_t joint) const noexcept { return joints_[joint].count; }
  std::int64_t cycle() const noexcept { return cycle_; }

 private:
  struct Drawn {
    std::int64_t challenge = 0;
    std::int64_t cycle = 0;
    std::int64_t number = 0;
  };
  /// Stops and faults of a joint, each as the number of the last draw before it. Challenges up to this number are older.
  struct JointStops {
    std::int64_t any = 0;     ///< the last stop or fault
    std::int64_t sent = 0;    ///< the last stop, `last`
    std::int64_t others = 0;  ///< the last stop of a sender other than that of `last`
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
  std::int64_t faulted_cycle_ = -1;  ///< the last cycle in which any joint faulted
  bool due_soon_ = false;
  // Holds all challenges that can be drawn while one is valid: nine eighths of a lifetime.
  std::array<Drawn, kAtOncePerLifetime + 2 * kMostPerLifetime> drawn_{};
  std::size_t newest_ = 0;
};

}  // namespace strainwave
