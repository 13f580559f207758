// SPDX-License-Identifier: BSD-3-Clause
// Matrices of rational numbers. Only functions that say so round. Not real-time: a product takes microseconds per entry.
#pragma once

#include <gmpxx.h>

#include <cstddef>
#include <vector>

namespace strainwave {

template <typename Number>
class ExactMatrix {
 public:
  ExactMatrix() = default;
  /// A matrix of zeros.
  ExactMatrix(std::size_t rows, std::size_t columns)
      : rows_(rows), columns_(columns), entries_(rows * columns) {}
  static ExactMatrix identity(std::size_t size, const Number& diagonal = 1) {
    ExactMatrix result(size, size);
    for (std::size_t i = 0; i < size; ++i) result(i, i) = diagonal;
    return result;
  }

  std::size_t rows() const { return rows_; }
  std::size_t columns() const { return columns_; }
  Number& operator()(std::size_t row, std::size_t column) { return entries_[row * columns_ + column]; }
  const Number& operator()(std::size_t row, std::size_t column) const {
    return entries_[row * columns_ + column];
  }

 private:
  std::size_t rows_ = 0;
  std::size_t columns_ = 0;
  std::vector<Number> entries_;
};

/// Applies `function` to the entries of `a` and `b` at the same place.
template <typename Number, typename Function>
ExactMatrix<Number> zipped(const ExactMatrix<Number>& a, const ExactMatrix<Number>& b,
                           const Function& function) {
  ExactMatrix<Number> result(a.rows(), a.columns());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t j = 0; j < a.columns(); ++j) result(i, j) = function(a(i, j), b(i, j));
  return result;
}

template <typename Number>
ExactMatrix<Number> operator+(const ExactMatrix<Number>& a, const ExactMatrix<Number>& b) {
  return zipped(a, b, [](const Number& x, const Number& y) { return Number(x + y); });
}

template <typename Number>
ExactMatrix<Number> operator-(const ExactMatrix<Number>& a, const ExactMatrix<Number>& b) {
  return zipped(a, b, [](const Number& x, const Number& y) { return Number(x - y); });
}

template <typename Number>
ExactMatrix<Number> operator*(const ExactMatrix<Number>& a, const ExactMatrix<Number>& b) {
  ExactMatrix<Number> result(a.rows(), b.columns());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t k = 0; k < a.columns(); ++k) {
      if (a(i, k) == 0) continue;
      for (std::size_t j = 0; j < b.columns(); ++j)
        if (b(k, j) != 0) result(i, j) += a(i, k) * b(k, j);
    }
  return result;
}

template <typename Number>
ExactMatrix<Number> operator*(const Number& factor, const ExactMatrix<Number>& a) {
  return zipped(a, a, [&factor](const Number& x, const Number&) { return Number(factor * x); });
}

template <typename Number>
ExactMatrix<Number> transpose(const ExactMatrix<Number>& a) {
  ExactMatrix<Number> result(a.columns(), a.rows());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t j = 0; j < a.columns(); ++j) result(j, i) = a(i, j);
  return result;
}

using RationalMatrix = ExactMatrix<mpq_class>;

/// The absolute value of each entry, and the larger of the two entries at each place.
RationalMatrix magnitude(const RationalMatrix& a);
RationalMatrix larger(const RationalMatrix& a, const RationalMatrix& b);

/// Whether the symmetric matrix is positive definite: every pivot of its elimination is above 0. Exact.
bool is_positive_definite(const RationalMatrix& symmetric);

/// All matrices within `radius` of `value`, entry by entry.
struct Enclosure {
  RationalMatrix value;
  RationalMatrix radius;  ///< >= 0
};

/// Encloses exp(M): the radius covers the rest of the series and the rounding to 2^-128. Any `scale` > 0, one number per row, is valid.
/// With beta = max_i sum_j |M_ij| scale_j / scale_i, |M^k|_ij <= beta^k scale_i / scale_j. beta sets the number of terms; above 32: std::domain_error.
Enclosure exponential(const RationalMatrix& M, const std::vector<mpq_class>& scale);

/// A bound, entry by entry, of max |d2/dt2 exp(A + t N)| / 8 over all |A + t N| <= `size`, with |N| = `change`. It
/// is a quarter of the upper right block of exp [S N 0; 0 S N; 0 0 S], as a comparison of the series shows.
RationalMatrix interpolation_bound(const RationalMatrix& size, const RationalMatrix& change,
                                   const std::vector<mpq_class>& scale);

}  // namespace strainwave
