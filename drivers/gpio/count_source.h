// SPDX-License-Identifier: BSD-3-Clause
// Source of a joint's position, in counts. read() and clear_fault() are real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

class CountSource {
 public:
  enum class State {
    kFresh,       ///< the counts are those of this period
    kStale,       ///< no sample in this period
    kImplausible  ///< counts are missing or wrong until clear_fault()
  };
  struct Sample {
    std::int64_t counts = 0;  ///< accumulated since the start; the last known value when not fresh
    State state = State::kStale;
  };

  virtual ~CountSource() = default;
  virtual Sample read(std::int64_t now_ns) noexcept = 0;
  virtual void clear_fault() noexcept = 0;
};

}  // namespace strainwave
