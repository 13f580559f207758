// SPDX-License-Identifier: BSD-3-Clause
// Counts the messages of a sender that did not arrive. LCM numbers the messages of each source consecutively, so it does not
// matter where they were lost. Bounded; allocates only in its constructor. Not real-time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "transport/lcm_reassembly.h"

namespace strainwave {

class MissingMessages {
 public:
  static constexpr std::size_t kSources = 64;
  /// A larger step in the numbers means a new sender on an old port.
  static constexpr std::int32_t kFarthest = 1 << 24;

  MissingMessages() { sources_.reserve(kSources); }

  /// Notes a message that arrived. Sources beyond the first kSources are ignored.
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

  /// Number of missing messages between the first message of `from` and its last. Duplicates hide missing ones.
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
    std::uint64_t before = 0;  ///< missing messages of earlier senders on this port
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
