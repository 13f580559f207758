// SPDX-License-Identifier: BSD-3-Clause
// minimise 1/2 x'Hx - g'x subject to x >= 0, H symmetric positive definite: the normal equations of a
// non-negative least-squares problem. Offline; no allocation. Source: Bro and de Jong, "A fast
// non-negativity-constrained least squares algorithm", J. Chemometrics 11 (1997), after Lawson and Hanson.
#pragma once

#include <Eigen/Core>
#include <array>

namespace strainwave {

inline constexpr int kMaxNonnegativeUnknowns = 3 * 16;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMaxNonnegativeUnknowns, 1>;
using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMaxNonnegativeUnknowns,
                                  kMaxNonnegativeUnknowns>;

/// Unknowns that are free (not held at zero), ascending.
struct FreeUnknowns {
  std::array<Eigen::Index, kMaxNonnegativeUnknowns> index{};
  Eigen::Index count = 0;
  Eigen::Index operator[](Eigen::Index i) const { return index[static_cast<std::size_t>(i)]; }
};
FreeUnknowns all_free(Eigen::Index count);
/// Rows and columns of `H` that are free.
SmallMatrix free_part(const SmallMatrix& H, const FreeUnknowns& free);

struct NonnegativeSolution {
  SmallVector x;
  FreeUnknowns free;
};

/// At most kMaxNonnegativeUnknowns unknowns.
NonnegativeSolution solve_nonnegative(const SmallMatrix& H, const SmallVector& g);

}  // namespace strainwave
