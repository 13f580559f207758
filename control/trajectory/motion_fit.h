// What a motion is at its newest sample, by least squares: where samples are rounded, a polynomial through a few of them follows their rounding, and
// fewer of them say too little of the motion. Real-time safe.
//
//   fit       polynomial of degree 5 that is nearest to the last fourteen samples
//   miss      by how much its motion from one sample on misses the next
//   helps     the mean of (m'^2 - m^2) / (m'^2 + m^2) over the last sixteen or so is below 0.1, m' by how much the fit missed, m what
//             would be taken else: what is about as good an interval on is better farther on, where rounding has grown more
#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace strainwave {

class MotionFit {
 public:
  static constexpr std::size_t kSamples = 14;
  using Samples = std::array<double, kSamples>;

  void forget() noexcept { *this = {}; }
  /// Before fit() of the sample that came `since_s` > 0 after the last, by `way` from it; what would be taken else missed it by `missed`.
  void weigh(double since_s, double way, double missed) noexcept {
    if (!known_) return;
    const double predicted = since_s * (first_ + since_s * (0.5 * second_ + since_s * third_ / 6.0));
    const double own = (predicted - way) * (predicted - way), other = missed * missed;
    count_ = std::min(count_ + 1, kWeighed);
    if (own + other > 0.0) worse_ += ((own - other) / (own + other) - worse_) / count_;
  }
  /// Newest first: ages >= 0, each greater than the one before, the first 0.
  void fit(const Samples& ages_s, const Samples& values) noexcept {
    using Terms = Eigen::Matrix<double, kDegree + 1, 1>;
    Eigen::Matrix<double, kDegree + 1, kDegree + 1> normal =
        decltype(normal)::Zero();  // of time in units of the oldest's age
    Terms moments = Terms::Zero();
    const double oldest_s = ages_s.back();
    for (std::size_t i = 0; i < kSamples; ++i) {
      Terms powers = Terms::Ones();
      for (int k = 1; k <= kDegree; ++k) powers[k] = -powers[k - 1] * ages_s[i] / oldest_s;
      normal += powers * powers.transpose();
      moments += powers * (values[i] - values[0]);
    }
    const Terms terms = normal.ldlt().solve(moments);
    first_ = terms[1] / oldest_s;
    second_ = 2.0 * terms[2] / (oldest_s * oldest_s);
    third_ = 6.0 * terms[3] / (oldest_s * oldest_s * oldest_s);
    known_ = std::isfinite(first_) && std::isfinite(second_) && std::isfinite(third_);
  }
  /// There are too few samples.
  void no_fit() noexcept { known_ = false; }
  bool helps() const noexcept { return known_ && count_ >= kLeast && worse_ < kHelps; }
  /// At the newest sample, by time.
  double first() const noexcept { return first_; }
  double second() const noexcept { return second_; }
  double third() const noexcept { return third_; }

 private:
  static constexpr int kDegree = 5;
  static constexpr int kWeighed = 16;
  static constexpr int kLeast = 4;
  static constexpr double kHelps = 0.1;
  bool known_ = false;
  double first_ = 0.0;
  double second_ = 0.0;
  double third_ = 0.0;
  double worse_ = 0.0;
  int count_ = 0;  ///< samples that were weighed, up to kWeighed
};

}  // namespace strainwave
