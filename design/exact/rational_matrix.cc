// SPDX-License-Identifier: BSD-3-Clause
#include "design/exact/rational_matrix.h"

#include <algorithm>
#include <stdexcept>

namespace strainwave {

namespace {

using IntegerMatrix = ExactMatrix<mpz_class>;

// Numbers are rounded to multiples of 2^-kBits. The series continues until its rest is at most eight of these.
constexpr mp_bitcnt_t kBits = 128;
// Larger norms, which need more terms, are refused. No joint at a useful period has one.
constexpr int kMostNorm = 32;

mpq_class unit() {
  return mpq_class(1, mpz_class(1) << kBits);
}

/// The multiple of 2^-kBits at or below a / b, b > 0.
mpq_class rounded_down(const mpz_class& a, const mpz_class& b) {
  mpz_class quotient;
  const mpz_class shifted = a << kBits;
  mpz_fdiv_q(quotient.get_mpz_t(), shifted.get_mpz_t(), b.get_mpz_t());
  mpq_class result(quotient, mpz_class(1) << kBits);
  result.canonicalize();
  return result;
}

/// A multiple of 2^-kBits above `value`.
mpq_class rounded_up(const mpq_class& value) {
  return rounded_down(value.get_num(), value.get_den()) + unit();
}

/// The least d > 0 for which d a is a matrix of integers.
mpz_class common_denominator(const RationalMatrix& a) {
  mpz_class common = 1;
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t j = 0; j < a.columns(); ++j)
      mpz_lcm(common.get_mpz_t(), common.get_mpz_t(), a(i, j).get_den_mpz_t());
  return common;
}

IntegerMatrix numerators(const RationalMatrix& a, const mpz_class& denominator) {
  IntegerMatrix result(a.rows(), a.columns());
  for (std::size_t i = 0; i < a.rows(); ++i)
    for (std::size_t j = 0; j < a.columns(); ++j)
      result(i, j) = a(i, j).get_num() * (denominator / a(i, j).get_den());
  return result;
}

mpq_class norm(const RationalMatrix& a, const std::vector<mpq_class>& scale) {
  mpq_class largest = 0;
  for (std::size_t i = 0; i < a.rows(); ++i) {
    mpq_class sum = 0;
    for (std::size_t j = 0; j < a.columns(); ++j) sum += abs(a(i, j)) * scale[j] / scale[i];
    largest = std::max(largest, sum);
  }
  return rounded_up(largest);
}

/// The number of the last summed term of exp(beta), and a bound of the sum of all later terms.
struct Tail {
  unsigned long last = 0;
  mpq_class sum;
};
Tail tail_of_series(const mpq_class& beta) {
  if (beta > kMostNorm)
    throw std::domain_error(
        "the period is too long for an exact proof: the joint's resonance or friction needs too many terms "
        "of a series");
  mpq_class term = 1;
  for (unsigned long k = 1;; ++k) {
    term = rounded_up(term * beta / k);
    // Every further term is at most half of the one before.
    if (k + 1 > 2 * beta && term <= 4 * unit()) return {k - 1, 2 * term};
  }
}

}  // namespace

RationalMatrix magnitude(const RationalMatrix& a) {
  return zipped(a, a, [](const mpq_class& x, const mpq_class&) { return mpq_class(abs(x)); });
}

RationalMatrix larger(const RationalMatrix& a, const RationalMatrix& b) {
  return zipped(a, b, [](const mpq_class& x, const mpq_class& y) { return std::max(x, y); });
}

// Bareiss elimination avoids fractions. Its pivots are the leading minors times a positive number.
bool is_positive_definite(const RationalMatrix& symmetric) {
  const std::size_t n = symmetric.rows();
  IntegerMatrix a = numerators(symmetric, common_denominator(symmetric));
  mpz_class previous = 1;
  for (std::size_t k = 0; k < n; ++k) {
    if (a(k, k) <= 0) return false;
    for (std::size_t i = k + 1; i < n; ++i)
      for (std::size_t j = i; j < n; ++j) {
        a(i, j) = a(k, k) * a(i, j) - a(k, i) * a(k, j);
        mpz_divexact(a(i, j).get_mpz_t(), a(i, j).get_mpz_t(), previous.get_mpz_t());
      }
    previous = a(k, k);
  }
  return true;
}

// Horner's rule Z / q = I + M (Z / q) / k, with a matrix of integers Z.
Enclosure exponential(const RationalMatrix& M, const std::vector<mpq_class>& scale) {
  const std::size_t n = M.rows();
  const Tail tail = tail_of_series(norm(M, scale));
  const mpz_class denominator = common_denominator(M);
  const IntegerMatrix N = numerators(M, denominator);
  IntegerMatrix Z = IntegerMatrix::identity(n);
  mpz_class q = 1;
  for (unsigned long k = tail.last; k > 0; --k) {
    q *= denominator * k;
    Z = IntegerMatrix::identity(n, q) + N * Z;
  }
  Enclosure result{RationalMatrix(n, n), RationalMatrix(n, n)};
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      result.value(i, j) = rounded_down(Z(i, j), q);
      result.radius(i, j) = rounded_up(tail.sum * scale[i] / scale[j]) + unit();
    }
  return result;
}

RationalMatrix interpolation_bound(const RationalMatrix& size, const RationalMatrix& change,
                                   const std::vector<mpq_class>& scale) {
  const std::size_t n = size.rows();
  RationalMatrix blocks(3 * n, 3 * n);
  std::vector<mpq_class> scales;
  for (std::size_t block = 0; block < 3; ++block) {
    scales.insert(scales.end(), scale.begin(), scale.end());
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) {
        if (size(i, j) != 0) blocks(block * n + i, block * n + j) = rounded_up(size(i, j));
        if (block < 2 && change(i, j) != 0)
          blocks(block * n + i, (block + 1) * n + j) = rounded_up(change(i, j));
      }
  }
  const Enclosure all = exponential(blocks, scales);
  RationalMatrix result(n, n);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      result(i, j) = (all.value(i, 2 * n + j) + all.radius(i, 2 * n + j)) / 4;
  return result;
}

}  // namespace strainwave
