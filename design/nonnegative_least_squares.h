// minimise 1/2 x'Hx - g'x subject to x >= 0, H symmetric positive definite: the normal equations of a
// non-negative least-squares problem. Offline; no allocation after the first call of a size. Source: Bro and
// de Jong, "A fast non-negativity-constrained least squares algorithm", J. Chemometrics 11 (1997), after
// Lawson and Hanson.
#pragma once

#include <Eigen/Core>

namespace strainwave {

inline constexpr int kMaxNonnegativeUnknowns = 3 * 16;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxNonnegativeUnknowns, 1>;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxNonnegativeUnknowns,
                                  kMaxNonnegativeUnknowns>;

/// At most kMaxNonnegativeUnknowns unknowns.
SmallVector solve_nonnegative(const SmallMatrix& H, const SmallVector& g);

}  // namespace strainwave
