// SPDX-License-Identifier: BSD-3-Clause
// A number with a bound on its error: running error analysis for proofs in floating point. Real-time safe.
//
// |value - exact| <= error always holds; "exact" is the same formula in real numbers. Each operation adds its own largest rounding
// error (half a unit in the last place, 2^-53 relative) to the bounds of its operands. The bound is rounded up by kUp and is never
// zero after an inexact operation. Source: Higham, "Accuracy and Stability of Numerical Algorithms", section 3.3.
#pragma once

#include <cmath>
#include <limits>

namespace strainwave {

struct Bounded {
  double value = 0.0;
  double error = 0.0;  ///< >= 0

  constexpr Bounded() = default;
  /// A number taken as exact: a parameter, a gain.
  constexpr Bounded(double exact)
      : value(exact) {}  // NOLINT(google-explicit-constructor): 1.0 - x reads well
  constexpr Bounded(double approximate, double bound) : value(approximate), error(bound) {}
};

namespace bounded_detail {
inline constexpr double kHalfUlp = 0.5 * std::numeric_limits<double>::epsilon();
inline constexpr double kUnderflow = std::numeric_limits<double>::min();
/// Covers the rounding of the up to eight operations that form one bound.
inline constexpr double kUp = 1.0 + 16.0 * std::numeric_limits<double>::epsilon();

inline Bounded rounded(double value, double inherited) noexcept {
  return {value, kUp * (inherited + kHalfUlp * std::abs(value)) + kUnderflow};
}
}  // namespace bounded_detail

inline Bounded operator-(const Bounded& a) noexcept {
  return {-a.value, a.error};
}

inline Bounded operator+(const Bounded& a, const Bounded& b) noexcept {
  return bounded_detail::rounded(a.value + b.value, a.error + b.error);
}

inline Bounded operator-(const Bounded& a, const Bounded& b) noexcept {
  return a + -b;
}

inline Bounded operator*(const Bounded& a, const Bounded& b) noexcept {
  if ((a.value == 0.0 && a.error == 0.0) || (b.value == 0.0 && b.error == 0.0)) return {};
  const double inherited = std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error;
  return bounded_detail::rounded(a.value * b.value, inherited);
}

/// Division by a number that is not zero within its error; otherwise the error is infinite.
inline Bounded operator/(const Bounded& a, const Bounded& b) noexcept {
  const double smallest = std::abs(b.value) - b.error;
  const double quotient = a.value / b.value;
  if (!(smallest > 0.0)) return {quotient, std::numeric_limits<double>::infinity()};
  return bounded_detail::rounded(quotient,
                                 bounded_detail::kUp * (a.error + std::abs(quotient) * b.error) / smallest);
}

}  // namespace strainwave
