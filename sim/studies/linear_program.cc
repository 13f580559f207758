// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/linear_program.h"

#include <Clp_C_Interface.h>
#include <algorithm>
#include <memory>

namespace strainwave {

int LinearProgram::add_unknown(double min, double max, double cost) {
  min_.push_back(min);
  max_.push_back(max);
  cost_.push_back(cost);
  return static_cast<int>(cost_.size()) - 1;
}

int LinearProgram::add_row(double min, double max) {
  row_min_.push_back(min);
  row_max_.push_back(max);
  return static_cast<int>(row_min_.size()) - 1;
}

LinearProgram::Solution LinearProgram::solve() const {
  std::vector<Entry> entries = entries_;
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.unknown != b.unknown ? a.unknown < b.unknown : a.row < b.row;
  });
  const auto unknowns = static_cast<int>(cost_.size());
  std::vector<CoinBigIndex> starts(cost_.size() + 1, 0);
  std::vector<int> rows;
  std::vector<double> values;
  for (const Entry& entry : entries) {
    ++starts[static_cast<std::size_t>(entry.unknown) + 1];
    rows.push_back(entry.row);
    values.push_back(entry.value);
  }
  for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];

  const std::unique_ptr<Clp_Simplex, void (*)(Clp_Simplex*)> model(Clp_newModel(), &Clp_deleteModel);
  Clp_setLogLevel(model.get(), 0);
  Clp_loadProblem(model.get(), unknowns, static_cast<int>(row_min_.size()), starts.data(), rows.data(),
                  values.data(), min_.data(), max_.data(), cost_.data(), row_min_.data(), row_max_.data());
  Clp_initialDualSolve(model.get());
  Solution solution;
  solution.optimal = Clp_status(model.get()) == 0;
  if (!solution.optimal) return solution;
  solution.cost = Clp_objectiveValue(model.get());
  const double* x = Clp_primalColumnSolution(model.get());
  solution.unknowns.assign(x, x + unknowns);
  return solution;
}

}  // namespace strainwave
