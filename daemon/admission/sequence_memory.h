// SPDX-License-Identifier: BSD-3-Clause
// Remembers the last sequence of each key for each joint, to refuse repeated and reordered orders. An order older than its lifetime is
// refused for its challenge, so no sequence needs to be remembered longer. Bounded. Not real-time.
#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>

namespace strainwave {

class SequenceMemory {
 public:
  enum class Judgement {
    kNew,     ///< rising; remembered from now on
    kRepeat,  ///< the very message that was judged last
    kOld,
  };
  /// The owner of a sequence: a key, or a sender without a key, on one joint.
  struct Identity {
    std::int64_t who = 0;
    std::size_t joint = 0;
    // clang-tidy 14 mistakes the 0 in comparisons of an ordering for a pointer.
    auto operator<=>(const Identity&) const = default;  // NOLINT(modernize-use-nullptr)
  };

  /// `bound`: number of identities; beyond it the one that was silent longest is forgotten.
  SequenceMemory(std::int64_t lifetime_cycles, std::size_t bound)
      : lifetime_cycles_(lifetime_cycles), bound_(std::max<std::size_t>(bound, 1)) {}

  /// Call only for a message that is known to come from `identity`, and whose challenge is recent at `cycle`.
  Judgement judge(Identity identity, std::int64_t sender_id, std::int64_t sequence, std::int64_t cycle) {
    const auto known = last_.find(identity);
    if (is_last(identity, sender_id, sequence)) return Judgement::kRepeat;
    if (known != last_.end()) {
      const Last& last = known->second;
      if (sequence <= last.sequence && cycle - last.cycle <= lifetime_cycles_) return Judgement::kOld;
    } else if (last_.size() >= bound_) {
      forget_longest_silent();
    }
    last_[identity] = {sender_id, sequence, cycle};
    return Judgement::kNew;
  }

  /// Whether this is the very message that was judged last.
  bool is_last(Identity identity, std::int64_t sender_id, std::int64_t sequence) const {
    const auto known = last_.find(identity);
    return known != last_.end() && known->second.sequence == sequence && known->second.sender_id == sender_id;
  }

  /// The last sequence of `identity`, 0 when there is none.
  std::int64_t last(Identity identity) const {
    const auto known = last_.find(identity);
    return known == last_.end() ? 0 : known->second.sequence;
  }

  std::size_t size() const noexcept { return last_.size(); }

 private:
  struct Last {
    std::int64_t sender_id;
    std::int64_t sequence;
    std::int64_t cycle;
  };
  void forget_longest_silent() {
    last_.erase(std::min_element(last_.begin(), last_.end(), [](const auto& a, const auto& b) {
      return a.second.cycle < b.second.cycle;
    }));
  }

  std::int64_t lifetime_cycles_;
  std::size_t bound_;
  std::map<Identity, Last> last_;
};

}  // namespace strainwave
