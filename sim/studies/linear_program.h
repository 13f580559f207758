// SPDX-License-Identifier: BSD-3-Clause
// Linear programmes, solved by CLP. Only this class of the simulator uses the solver. Offline.
//   minimise c'x   subject to   row_min <= A x <= row_max,   x_min <= x <= x_max
#pragma once

#include <limits>
#include <vector>

namespace strainwave {

class LinearProgram {
 public:
  static constexpr double kFree = std::numeric_limits<double>::infinity();

  /// Adds an unknown with its bounds and cost; returns its number.
  int add_unknown(double min, double max, double cost = 0.0);
  /// Adds a row with its bounds; returns its number.
  int add_row(double min, double max);
  /// Sets the coefficient of the unknown in the row; each pair only once.
  void set(int row, int unknown, double value) { entries_.push_back({unknown, row, value}); }

  struct Solution {
    bool optimal = false;  ///< false: infeasible or given up
    double cost = 0.0;
    std::vector<double> unknowns;
  };
  Solution solve() const;

 private:
  struct Entry {
    int unknown, row;
    double value;
  };
  std::vector<double> min_, max_, cost_, row_min_, row_max_;
  std::vector<Entry> entries_;
};

}  // namespace strainwave
