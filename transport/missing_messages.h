// SPDX-License-Identifier: BSD-3-Clause
// How many messages of a sender did not come, by the numbers that LCM gives to what is sent from one source, one after the other. It does not
// matter where they were lost. Bounded; allocates nothing after its start. Not real-time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "transport/lcm_reassembly.h"

namespace strainwave {

class MissingMessages {
 public:
  static constexpr std::size_t kSources = 64;
  /// A number farther off than this belongs to a new sender on an old port.
  static constexpr std::int32_t kFarthest = 1 << 24;

  MissingMessages() { sources_.reserve(kSources); }

  /// A message came. Of sources beyond kSources nothing is known.
  void heard(const LcmSource& from, std::uint32_t sequence) {
    Source* const known = find(from);
    if (known == nullptr) {
      if (sources_.size() < kSources) sources_.push_back({from, sequence, 1, 1, 0});
      return;
    }
    const auto step = static_cast<std::int32_t>(sequence - known->highest);
    if (step > kFarthest || step < -kFarthest) {
      *known = {from, sequence, 1, 1, missing(*known)};
      return;
    }
    ++known->came;
    if (step <= 0) return;  // overtaken by a later one
    known->highest = sequence;
    known->sent += static_cast<std::uint64_t>(step);
  }

  /// Between the first message of `from` and its last. Copies of messages hide others.
  std::uint64_t of(const LcmSource& from) const noexcept {
    const auto known = std::ranges::find(sources_, from, &Source::from);
    return known == sources_.end() ? 0 : missing(*known);
  }

  void clear() noexcept { sources_.clear(); }

 private:
  struct Source {
    LcmSource from;
    std::uint32_t highest = 0;
    std::uint64_t sent = 0;
    std::uint64_t came = 0;
    std::uint64_t before = 0;  ///< missing of earlier senders on this port
  };
  static std::uint64_t missing(const Source& source) noexcept {
    return source.before + (source.sent > source.came ? source.sent - source.came : 0);
  }
  Source* find(const LcmSource& from) noexcept {
    const auto known = std::ranges::find(sources_, from, &Source::from);
    return known == sources_.end() ? nullptr : &*known;
  }

  std::vector<Source> sources_;
};

}  // namespace strainwave
