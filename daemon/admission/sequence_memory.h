// The last sequence of each recent sender of one key: what stops replays. Bounded, and forgetting reopens
// nothing: a sender that is not remembered is believed only above every sequence that was forgotten. Not
// real-time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>

namespace strainwave {

class SequenceMemory {
 public:
  /// More programs than use one key at a time; more of them take turns without harm as long as their
  /// sequences follow the clock.
  static constexpr std::size_t kSenders = 64;

  enum class Judgement {
    kNew,     ///< rising: remembered from now on
    kRepeat,  ///< the very message that was judged last of this sender
    kOld,
  };

  /// `keeps_floor` false: for senders without a key, among whom anybody could raise the floor for all.
  explicit SequenceMemory(bool keeps_floor = true) : keeps_floor_(keeps_floor) {}

  /// Call only for a message that is known to come from the key's owner.
  Judgement judge(std::int64_t sender_id, std::int64_t sequence) {
    const auto known = last_.find(sender_id);
    if (known != last_.end()) {
      if (sequence == known->second) return Judgement::kRepeat;
      if (sequence < known->second) return Judgement::kOld;
      known->second = sequence;
      return Judgement::kNew;
    }
    if (sequence <= floor_) return Judgement::kOld;
    if (last_.size() >= kSenders) forget_lowest();
    last_.emplace(sender_id, sequence);
    return Judgement::kNew;
  }

  std::size_t size() const noexcept { return last_.size(); }

 private:
  void forget_lowest() {
    const auto lowest = std::min_element(last_.begin(), last_.end(),
                                         [](const auto& a, const auto& b) { return a.second < b.second; });
    if (keeps_floor_) floor_ = std::max(floor_, lowest->second);
    last_.erase(lowest);
  }

  bool keeps_floor_;
  std::int64_t floor_ = std::numeric_limits<std::int64_t>::min();
  std::map<std::int64_t, std::int64_t> last_;
};

}  // namespace strainwave
