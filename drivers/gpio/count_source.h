// SPDX-License-Identifier: BSD-3-Clause
// Where a joint's position comes from, in counts. read() and clear_fault() are real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

class CountSource {
 public:
  enum class State {
    kFresh,       ///< counts are of now
    kStale,       ///< no sample this time
    kImplausible  ///< counts are missing or wrong until clear_fault()
  };
  struct Sample {
    std::int64_t counts = 0;  ///< since the start, accumulated; the last known ones when not fresh
    State state = State::kStale;
  };

  virtual ~CountSource() = default;
  virtual Sample read(std::int64_t now_ns) noexcept = 0;
  virtual void clear_fault() noexcept = 0;
};

}  // namespace strainwave
