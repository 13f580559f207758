// Whether a loop that is locked to the rhythm of a stream has locked to something else: to a part or a multiple of its interval, as the first
// two samples of a stream need not lie in its rhythm and some after them may have been lost, or to one that the sender no longer keeps.
// Real-time safe.
//
//   usual gap   median of the last gaps between arrivals: what losses lengthen and hold-ups move are fewer
//   contradicts three fifths of the gaps are about the usual one, and of those that are about the interval there are less than half as many;
//               in the first fifteen gaps, where the interval differs from their mean by more than 4 % and what the network may do to that
//
// About as long are gaps that differ by a quarter, or by what a network does to arrivals all the time: of a stream that is faster than that
// nothing is said.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace strainwave {

class UsualGap {
 public:
  void forget() noexcept { count_ = next_ = 0; }
  /// One comes `gap` >= 0 after the one before, of which `jitter` may be the network's. True: not `interval` is the interval, but that of
  /// interval().
  bool take(double gap, double interval, double jitter) noexcept {
    gaps_[next_] = gap;
    next_ = (next_ + 1) % kGaps;
    const bool few = count_ < kGaps;
    count_ = std::min(count_ + 1, kGaps);
    const double usual = median();
    const double tolerance = 0.5 * jitter;
    // One that comes at once was held up, and says nothing of its place in the rhythm.
    if (count_ < kLeast || usual <= jitter || gap < 0.5 * usual) return false;
    std::size_t usual_ones = 0;
    std::size_t at_once = 0;
    std::size_t intervals = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (about(gaps_[i], interval, tolerance)) ++intervals;
      if (about(gaps_[i], usual, tolerance)) ++usual_ones;
      if (gaps_[i] < 0.5 * usual) ++at_once;
    }
    if (5 * usual_ones < 3 * count_ || 5 * at_once > count_) return false;
    if (!find_rhythm(usual, tolerance)) return false;
    if (few) return std::abs(interval_ - interval) > std::max(kClose * interval_, jitter / told_by_);
    if (about(interval, usual, tolerance) || usual_ones < 2 * intervals + kMore) return false;
    forget();
    return true;
  }
  /// After take() was true: mean interval, how much later than in its rhythm the last came, and how many gaps tell it.
  double interval() const noexcept { return interval_; }
  double late() const noexcept { return late_; }
  int told_by() const noexcept { return told_by_; }

 private:
  static constexpr std::size_t kGaps = 15;
  static constexpr std::size_t kLeast = 3;  ///< gaps, before anything is said
  static constexpr std::size_t kMore = 3;
  static constexpr double kMostLost = 4.0;  ///< intervals that a gap is of
  /// Share of the interval that a loop which has just begun may be wrong by.
  static constexpr double kClose = 0.04;
  static constexpr double kSame = 0.25;  ///< share of a gap by which others may differ

  static bool about(double gap, double other, double tolerance) noexcept {
    return std::abs(gap - other) <= std::max(kSame * other, tolerance);
  }
  double newest(std::size_t i) const noexcept { return gaps_[(next_ + kGaps - 1 - i) % kGaps]; }
  /// From the last gap back to the first that is no multiple of the interval, or of more than losses make it. False: the last is none.
  bool find_rhythm(double usual, double tolerance) noexcept {
    double sum = 0.0, intervals = 0.0, late = 0.0;
    std::size_t i = 0;
    for (; i < count_; ++i) {
      const double gap = newest(i);
      const double multiple = std::round(gap / usual);
      if (multiple > kMostLost || !about(gap - (multiple - 1.0) * usual, usual, tolerance)) break;
      sum += gap;
      intervals += multiple;
      late += sum - intervals * usual;
    }
    told_by_ = static_cast<int>(i);
    if (i == 0) return false;
    late_ = late / static_cast<double>(i + 1);
    interval_ = sum / intervals;
    return true;
  }
  double median() const noexcept {
    std::array<double, kGaps> sorted = gaps_;
    const auto middle = static_cast<std::ptrdiff_t>((count_ - 1) / 2);
    std::nth_element(sorted.begin(), sorted.begin() + middle,
                     sorted.begin() + static_cast<std::ptrdiff_t>(count_));
    return sorted[static_cast<std::size_t>(middle)];
  }

  std::array<double, kGaps> gaps_{};
  std::size_t next_ = 0;
  std::size_t count_ = 0;
  double interval_ = 0.0;
  double late_ = 0.0;
  int told_by_ = 0;
};

}  // namespace strainwave
