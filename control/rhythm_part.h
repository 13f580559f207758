// Whether a loop that is locked to the rhythm of a stream has locked to a part of its interval: many samples in a row come about as long after the
// one before, or a multiple of that, and none after what the loop takes for the interval. Losses are not as regular; but the first two
// samples of a stream, from which a loop has its first interval, need not lie in its rhythm. Real-time safe.
#pragma once

#include <cmath>

namespace strainwave {

class RhythmPart {
 public:
  void forget() noexcept { *this = {}; }
  /// One comes `gap` after the one before, of which `jitter` may be the network's. True: the interval is that of interval().
  bool take(double gap, double interval, double jitter) noexcept {
    if (count_ == kInARow) forget();
    if (gap < kLonger * interval || gap - interval < jitter) {
      forget();
      return false;
    }
    const double ratio = count_ > 0 ? gap / first_ : 0.0;
    if (std::abs(std::remainder(ratio, 1.0)) > kSame || ratio < 1.0 - kSame) {
      forget();
      first_ = gap;
    }
    sum_ += gap;
    intervals_ += std::round(gap / first_);
    return ++count_ == kInARow;
  }
  /// After take() was true.
  double interval() const noexcept { return sum_ / intervals_; }

 private:
  static constexpr int kInARow = 10;
  static constexpr double kSame = 0.25;   ///< share of a gap by which others may differ
  static constexpr double kLonger = 1.5;  ///< intervals; less is none but the next
  int count_ = 0;
  double first_ = 0.0;
  double sum_ = 0.0;
  double intervals_ = 0.0;  ///< in sum_, each about as long as the first
};

}  // namespace strainwave
