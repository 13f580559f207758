// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/nonnegative_least_squares.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace strainwave {

namespace {

using Index = Eigen::Index;
using Flags = std::array<bool, kMaxNonnegativeUnknowns>;

FreeUnknowns collect(const Flags& is_free, Index n) {
  FreeUnknowns free;
  for (Index i = 0; i < n; ++i) {
    if (is_free[static_cast<std::size_t>(i)]) free.index[static_cast<std::size_t>(free.count++)] = i;
  }
  return free;
}

// The minimum over the free unknowns; the others are zero.
SmallVector solve_free(const SmallMatrix& H, const SmallVector& g, const FreeUnknowns& free) {
  SmallVector x = SmallVector::Zero(g.size());
  if (free.count == 0) return x;
  SmallVector g_free(free.count);
  for (Index a = 0; a < free.count; ++a) g_free(a) = g(free[a]);
  const SmallVector solution = free_part(H, free).llt().solve(g_free);
  for (Index a = 0; a < free.count; ++a) x(free[a]) = solution(a);
  return x;
}

// Goes from x towards `target` until the first free unknown reaches zero, which it then holds. True on arrival.
bool walk(SmallVector& x, const SmallVector& target, const FreeUnknowns& free, Flags& is_free) {
  double step = 1.0;
  Index blocking = -1;
  for (Index a = 0; a < free.count; ++a) {
    const Index i = free[a];
    if (target(i) > 0.0) continue;
    const double way = x(i) - target(i);
    const double reach = way > 0.0 ? x(i) / way : 0.0;
    if (blocking < 0 || reach < step) {
      step = reach;
      blocking = i;
    }
  }
  if (blocking < 0) {
    x = target;
    return true;
  }
  x += step * (target - x);
  x = x.cwiseMax(0.0);
  x(blocking) = 0.0;
  is_free[static_cast<std::size_t>(blocking)] = false;
  return false;
}

}  // namespace

FreeUnknowns all_free(Index count) {
  FreeUnknowns free;
  free.count = count;
  for (Index i = 0; i < count; ++i) free.index[static_cast<std::size_t>(i)] = i;
  return free;
}

SmallMatrix free_part(const SmallMatrix& H, const FreeUnknowns& free) {
  SmallMatrix part(free.count, free.count);
  for (Index b = 0; b < free.count; ++b) {
    for (Index a = 0; a < free.count; ++a) part(a, b) = H(free[a], free[b]);
  }
  return part;
}

NonnegativeSolution solve_nonnegative(const SmallMatrix& H, const SmallVector& g) {
  const Index n = g.size();
  // Most fits hold few unknowns at zero. The first free ones are those that are positive without the constraint.
  const SmallVector unconstrained = solve_free(H, g, all_free(n));
  Flags is_free{};
  for (Index i = 0; i < n; ++i) is_free[static_cast<std::size_t>(i)] = unconstrained(i) > 0.0;
  NonnegativeSolution solution{unconstrained.cwiseMax(0.0), {}};
  SmallVector& x = solution.x;
  const double tolerance = 1e-12 * g.cwiseAbs().maxCoeff();
  // Each pass frees one unknown and lowers the cost, so that no set occurs twice. The limit is far above the
  // usual number of passes.
  for (Index pass = 0; pass < 10 * n; ++pass) {
    for (;;) {
      solution.free = collect(is_free, n);
      if (walk(x, solve_free(H, g, solution.free), solution.free, is_free)) break;
    }
    const SmallVector descent = g - H * x;
    Index best = -1;
    for (Index i = 0; i < n; ++i) {
      if (is_free[static_cast<std::size_t>(i)] || descent(i) <= tolerance) continue;
      if (best < 0 || descent(i) > descent(best)) best = i;
    }
    if (best < 0) break;
    is_free[static_cast<std::size_t>(best)] = true;
  }
  return solution;
}

}  // namespace strainwave
