// SPDX-License-Identifier: BSD-3-Clause
// commission_study [JOINTS [FIRST]]: the results of commissioning on random joints of the catalogue, as tables. It prints one line per joint
// on the standard error.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>

#include "base/parallel.h"
#include "commission/identification.h"
#include "sim/studies/statistics.h"
#include "sim/studies/text_table.h"
#include "tests/commission/random_joints.h"

namespace strainwave::testing {
namespace {

struct Row {
  RandomJoint joint;
  CommissionedJoint run;
  std::vector<Comparison> found;
  int windows = 0;
};

Row commission(std::uint64_t seed) {
  Row row{random_joint(seed), {}, {}, 0};
  row.run = excite(row.joint);
  if (row.run.problem.empty()) {
    const JointEstimates estimates = identify(row.run.trace, row.joint.told);
    row.found = compare(row.joint, estimates);
    row.windows = estimates.motion ? estimates.motion->windows : 0;
  }
  row.run.trace.samples.clear();
  return row;
}

void show(std::uint64_t seed, const Row& row) {
  std::fprintf(stderr, "%4lu %-10s %5.1f s %3d windows %s", static_cast<unsigned long>(seed),
               row.joint.gear.c_str(), row.run.duration_s, row.windows, row.run.problem.c_str());
  for (const Comparison& c : row.found) {
    if (c.absent)
      std::fprintf(stderr, ", %s: not found", c.quantity.c_str());
    else
      std::fprintf(stderr, ", %s%s %+.2f(%.2f)%s", c.found.holds(c.truth) ? "" : "*", c.quantity.c_str(),
                   c.error_in_unit(), c.half_width_in_unit(), c.unit());
  }
  std::fputc('\n', stderr);
}

std::string percent(std::size_t part, std::size_t whole) {
  return whole == 0 ? "-" : number(100.0 * static_cast<double>(part) / static_cast<double>(whole), 3) + " %";
}

TextTable ends(const std::vector<Row>& rows) {
  std::vector<double> durations;
  std::size_t ended = 0, whole = 0, violations = 0, faults = 0;
  for (const Row& row : rows) {
    durations.push_back(row.run.duration_s);
    violations += row.run.violations > 0 ? 1U : 0U;
    faults += row.run.faults > 0 ? 1U : 0U;
    if (!row.run.problem.empty()) continue;
    ++ended;
    bool all = true;
    for (const Comparison& c : row.found) all = all && !c.absent;
    whole += all ? 1U : 0U;
  }
  return {"Motion",
          {"joints", "ended", "every number found", "joint time median (s)", "longest (s)",
           "joints with a limit passed", "joints with a fault"},
          {{std::to_string(rows.size()), percent(ended, rows.size()), percent(whole, rows.size()),
            number(percentile(durations, 0.5), 3), number(percentile(durations, 1.0), 3),
            std::to_string(violations), std::to_string(faults)}}};
}

TextTable errors(const std::vector<Row>& rows) {
  TextTable table{"Errors and 95 % intervals",
                  {"number", "joints", "found", "error 50 %", "90 %", "100 %", "half width 50 %",
                   "intervals hold the truth"},
                  {}};
  std::vector<std::string> names;
  std::map<std::string, std::vector<Comparison>> by_name;
  for (const Row& row : rows)
    for (const Comparison& c : row.found) {
      if (by_name[c.quantity].empty()) names.push_back(c.quantity);
      by_name[c.quantity].push_back(c);
    }
  for (const std::string& name : names) {
    std::vector<double> sizes, widths;
    std::size_t held = 0;
    for (const Comparison& c : by_name[name]) {
      if (c.absent) continue;
      sizes.push_back(std::abs(c.error_in_unit()));
      widths.push_back(c.half_width_in_unit());
      held += c.found.holds(c.truth) ? 1U : 0U;
    }
    const auto text = [&](const std::vector<double>& values, double share) {
      return number(percentile(values, share), 2) + " " + by_name[name].front().unit();
    };
    table.rows.push_back({name, std::to_string(by_name[name].size()),
                          percent(sizes.size(), by_name[name].size()), text(sizes, 0.5), text(sizes, 0.9),
                          text(sizes, 1.0), text(widths, 0.5), percent(held, sizes.size())});
  }
  return table;
}

}  // namespace
}  // namespace strainwave::testing

int main(int argc, char** argv) {
  using namespace strainwave::testing;
  const int joints = argc > 1 ? std::atoi(argv[1]) : 10;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  std::vector<Row> rows(static_cast<std::size_t>(joints));
  strainwave::run_in_parallel(rows.size(), [&](std::size_t i) {
    const std::uint64_t seed = static_cast<std::uint64_t>(first) + i;
    rows[i] = commission(seed);
    show(seed, rows[i]);
  });
  std::cout << ends(rows).markdown() << '\n' << errors(rows).markdown();
}
