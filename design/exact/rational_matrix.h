// SPDX-License-Identifier: BSD-3-Clause
// Matrices of rational numbers, without any rounding but where a function says so. Not real-time: a product takes microseconds an entry.
#pragma once

#include <gmpxx.h>

#include <cstddef>
#include <vector>

namespace strainwave {

template <typename Number>
class ExactMatrix {
 public:
  ExactMatrix() = default;
  /// Zeros.
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

/// Entry by entry.
RationalMatrix magnitude(const RationalMatrix& a);
RationalMatrix larger(const RationalMatrix& a, const RationalMatrix& b);

/// Whether the symmetric matrix is positive definite: every pivot of its elimination is above 0. Exact.
bool is_positive_definite(const RationalMatrix& symmetric);

/// Any matrix within `radius` of `value`, entry by entry.
struct Enclosure {
  RationalMatrix value;
  RationalMatrix radius;  ///< >= 0
};

/// exp(M), with what the series and the rounding to 2^-128 leave out. Any `scale` > 0 proves, one number for each row: with the norm
/// beta = max_i sum_j |M_ij| scale_j / scale_i, the entries of M^k are at most beta^k scale_i / scale_j. The number of terms follows beta. Throws std::domain_error where beta is above 32.
Enclosure exponential(const RationalMatrix& M, const std::vector<mpq_class>& scale);

/// More than max |d2/dt2 exp(A + t N)| / 8 over all A + t N that are at most `size`, entry by entry; `change` = |N|. That is a quarter of the
/// block in the corner of exp [S N 0; 0 S N; 0 0 S], as comparing the series shows.
RationalMatrix interpolation_bound(const RationalMatrix& size, const RationalMatrix& change,
                                   const std::vector<mpq_class>& scale);

}  // namespace strainwave
