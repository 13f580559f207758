// SPDX-License-Identifier: BSD-3-Clause
// commission_study COUNT [FIRST]: what commissioning finds of random joints; one line a joint, then errors and intervals by quantity.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <map>

#include "commission/identification.h"
#include "tests/commission/random_joints.h"

int main(int argc, char** argv) {
  using namespace strainwave;
  using namespace strainwave::testing;
  const int count = argc > 1 ? std::atoi(argv[1]) : 10;
  const int first = argc > 2 ? std::atoi(argv[2]) : 1;
  std::map<std::string, std::vector<Comparison>> by_quantity;
  int problems = 0;
  for (int i = first; i < first + count; ++i) {
    const RandomJoint joint = random_joint(static_cast<std::uint64_t>(i));
    std::printf("%4d %-10s ", i, joint.gear.c_str());
    try {
      const CommissionedJoint run = excite(joint);
      std::printf("%6.1f s ", run.duration_s);
      if (!run.problem.empty()) {
        ++problems;
        std::printf("%s\n", run.problem.c_str());
        continue;
      }
      const JointEstimates found = identify(run.trace, joint.told);
      for (const Comparison& c : compare(joint, found)) {
        by_quantity[c.quantity].push_back(c);
        if (c.absent)
          std::printf(" %s -", c.quantity.c_str());
        else if (c.quantity == "delay")
          std::printf(" delay %+.3f ms", 1e3 * (c.found.value - c.truth));
        else
          std::printf(" %s %+.1f(%.1f)%%", c.quantity.c_str(), 100.0 * (c.found.value / c.truth - 1.0),
                      100.0 * c.found.half_width_95 / c.truth);
      }
      if (found.motion)
        std::printf(" windows %d residual %.1f urad", found.motion->windows,
                    1e6 * found.motion->residual_rad);
      std::printf("\n");
    } catch (const std::exception& error) {
      ++problems;
      std::printf("%s\n", error.what());
    }
    std::fflush(stdout);
  }
  std::printf("%d of %d ended early\n", problems, count);
  for (auto& [quantity, all] : by_quantity) {
    std::vector<double> errors;
    int held = 0, absent = 0;
    for (const Comparison& c : all) {
      absent += c.absent ? 1 : 0;
      held += !c.absent && c.found.holds(c.truth) ? 1 : 0;
      errors.push_back(quantity == "delay" ? 1e3 * std::abs(c.found.value - c.truth) : 100.0 * c.error());
    }
    std::sort(errors.begin(), errors.end());
    const auto at = [&](double share) {
      return errors[static_cast<std::size_t>(share * static_cast<double>(errors.size() - 1))];
    };
    std::printf(
        "%-14s n %4zu absent %3d error median %.2f p90 %.2f p95 %.2f worst %.2f %s, intervals hold %.1f %%\n",
        quantity.c_str(), all.size(), absent, at(0.5), at(0.9), at(0.95), at(1.0),
        quantity == "delay" ? "ms" : "%",
        100.0 * held / static_cast<double>(all.size() - static_cast<std::size_t>(absent)));
  }
}
