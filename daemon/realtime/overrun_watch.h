// Counts cycles that began late by a period or more: a few are noise of the machine, many in a row are a loop
// that no longer controls. Real-time safe.
#pragma once

#include <cstdint>

namespace strainwave {

class OverrunWatch {
 public:
  explicit OverrunWatch(int limit) noexcept : limit_(limit) {}

  /// One cycle that began after `skipped` periods were left out. True when it is the limit-th in a row.
  bool too_many(std::int64_t skipped) noexcept {
    in_a_row_ = skipped > 0 ? in_a_row_ + 1 : 0;
    if (in_a_row_ < limit_) return false;
    in_a_row_ = 0;
    return true;
  }

 private:
  int limit_;
  int in_a_row_ = 0;
};

}  // namespace strainwave
