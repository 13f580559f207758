#include "design/student.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace strainwave {

namespace {

// With t = sqrt(n) tan(u) the density becomes c cos(u)^(n-1) on (-pi/2, pi/2): smooth and bounded, so that
// Simpson's rule converges fast.
double probability_within(double angle, int n) {
  constexpr int kIntervals = 200;
  const double c = 1.0 / std::beta(0.5, 0.5 * n);
  const double h = angle / kIntervals;
  double sum = 0.0;
  for (int i = 0; i <= kIntervals; ++i) {
    const double weight = i == 0 || i == kIntervals ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
    sum += weight * std::pow(std::cos(i * h), n - 1);
  }
  return 2.0 * c * sum * h / 3.0;
}

}  // namespace

double student_t(double confidence, int degrees_of_freedom) {
  assert(confidence > 0.0 && confidence < 1.0 && degrees_of_freedom >= 1);
  double low = 0.0, high = 0.5 * std::numbers::pi;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (probability_within(middle, degrees_of_freedom) < confidence ? low : high) = middle;
  }
  return std::sqrt(degrees_of_freedom) * std::tan(0.5 * (low + high));
}

}  // namespace strainwave
