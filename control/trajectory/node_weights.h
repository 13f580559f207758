// How many samples a polynomial through them should have: by what such polynomials have missed of late. Where samples lie exactly, each more tells
// more of the motion; where they are off, by times that are not theirs or by rounding, each more doubles what that makes of what is to come.
// Real-time safe.
//
//   for polynomials through n samples and through n + 1, on each sample that came after them
//     more = (m'^2 - m^2) / (m'^2 + m^2)     m, m' by how much they missed it
//   the (n + 1)th helps while the mean of `more` over the last eight or so is at most -0.25
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

namespace strainwave {

class NodeWeights {
 public:
  static constexpr std::size_t kMost = 5;  ///< nodes of a polynomial
  /// [n]: by how much the polynomial through the n samples before it misses the newest, >= 0.
  using Missed = std::array<double, kMost + 1>;

  void forget() noexcept { *this = {}; }
  /// Of polynomials through up to `most` samples, at most kMost.
  void weigh(const Missed& missed, std::size_t most) noexcept {
    count_ = std::min(count_ + 1, kWeighed);
    for (std::size_t n = kLeast; n < most; ++n) {
      const double fewer = missed[n] * missed[n], more = missed[n + 1] * missed[n + 1];
      if (fewer + more > 0.0) worse_[n] += ((more - fewer) / (more + fewer) - worse_[n]) / count_;
    }
  }
  /// Whether it is better to take n + 1 samples than n, from 3 on. Until any has been weighed, yes.
  bool helps(std::size_t n) const noexcept { return count_ == 0 || worse_[n] <= kHelps; }

 private:
  static constexpr std::size_t kLeast = 3;
  static constexpr int kWeighed = 8;
  static constexpr double kHelps = -0.25;
  std::array<double, kMost> worse_{};
  int count_ = 0;  ///< samples, up to kWeighed
};

}  // namespace strainwave
