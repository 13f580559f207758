#include "design/nonnegative_least_squares.h"

#include <Eigen/Cholesky>
#include <array>

namespace strainwave {

namespace {

using Index = Eigen::Index;

struct PassiveSet {
  std::array<Index, kMaxNonnegativeUnknowns> index{};  // unknowns that are free, ascending
  Index count = 0;
};

PassiveSet collect(const std::array<bool, kMaxNonnegativeUnknowns>& passive, Index n) {
  PassiveSet set;
  for (Index i = 0; i < n; ++i) {
    if (passive[static_cast<std::size_t>(i)]) set.index[static_cast<std::size_t>(set.count++)] = i;
  }
  return set;
}

// The unconstrained minimum over the passive unknowns; the others are zero.
SmallVector solve_passive(const SmallMatrix& H, const SmallVector& g, const PassiveSet& set) {
  SmallMatrix H_passive(set.count, set.count);
  SmallVector g_passive(set.count);
  for (Index a = 0; a < set.count; ++a) {
    const Index i = set.index[static_cast<std::size_t>(a)];
    g_passive(a) = g(i);
    for (Index b = 0; b < set.count; ++b) H_passive(a, b) = H(i, set.index[static_cast<std::size_t>(b)]);
  }
  const SmallVector solution = H_passive.llt().solve(g_passive);
  SmallVector x = SmallVector::Zero(g.size());
  for (Index a = 0; a < set.count; ++a) x(set.index[static_cast<std::size_t>(a)]) = solution(a);
  return x;
}

}  // namespace

SmallVector solve_nonnegative(const SmallMatrix& H, const SmallVector& g) {
  const Index n = g.size();
  std::array<bool, kMaxNonnegativeUnknowns> passive{};
  // Most fits of ours have few active constraints: begin with every unknown free.
  for (Index i = 0; i < n; ++i) passive[static_cast<std::size_t>(i)] = true;
  SmallVector x = SmallVector::Zero(n);
  const double tolerance = 1e-12 * (1.0 + g.cwiseAbs().maxCoeff());
  // Each pass frees one unknown and lowers the cost; sets never repeat, and 10 n is far more than is ever
  // needed.
  for (Index pass = 0; pass < 10 * n; ++pass) {
    for (;;) {
      const PassiveSet set = collect(passive, n);
      if (set.count == 0) {
        x.setZero();
        break;
      }
      const SmallVector candidate = solve_passive(H, g, set);
      // Walk from x towards the candidate until the first unknown becomes negative, and fix that one at zero.
      double step = 1.0;
      for (Index a = 0; a < set.count; ++a) {
        const Index i = set.index[static_cast<std::size_t>(a)];
        if (candidate(i) <= 0.0) step = std::min(step, x(i) / (x(i) - candidate(i) + 1e-300));
      }
      if (step >= 1.0 && (candidate.array() >= 0.0).all()) {
        x = candidate;
        break;
      }
      x += step * (candidate - x);
      bool fixed = false;
      for (Index a = 0; a < set.count; ++a) {
        const Index i = set.index[static_cast<std::size_t>(a)];
        if (candidate(i) <= 0.0 && x(i) <= 1e-14 * (1.0 + std::abs(candidate(i)))) {
          x(i) = 0.0;
          passive[static_cast<std::size_t>(i)] = false;
          fixed = true;
        }
      }
      if (!fixed) break;
    }
    const SmallVector descent = g - H * x;
    Index best = -1;
    for (Index i = 0; i < n; ++i) {
      if (passive[static_cast<std::size_t>(i)] || descent(i) <= tolerance) continue;
      if (best < 0 || descent(i) > descent(best)) best = i;
    }
    if (best < 0) break;
    passive[static_cast<std::size_t>(best)] = true;
  }
  return x;
}

}  // namespace strainwave
