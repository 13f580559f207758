// SPDX-License-Identifier: BSD-3-Clause
// doctor_study [JOINTS [HEALTHY [FIRST [STRIDE [CAUSE]]]]]: the doctor on JOINTS joints with each cause, numbered from FIRST, and on HEALTHY
// healthy ones. Prints tables, and wrong diagnoses on the standard error. Publishes one of STRIDE periods. CAUSE: that cause alone, in full.
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <mutex>
#include <string>

#include "base/parallel.h"
#include "doctor/causes.h"
#include "doctor/diagnosis.h"
#include "doctor/motion_fit.h"
#include "sim/studies/text_table.h"
#include "tests/doctor/patient.h"

namespace strainwave::testing {
namespace {

void show_fit(const Evidence& evidence) {
  if (const auto fit = fit_motion(evidence))
    std::fprintf(
        stderr,
        "      fit J %.4f+-%.4f Fc %.3f+-%.3f Fv %.3f+-%.3f d %.2f+-%.2f K %.2f+-%.2f load %.2f+-%.2f rest "
        "%.3f windows %d\n",
        fit->inertia_kgm2.value, fit->inertia_kgm2.deviation, fit->coulomb_Nm.value,
        fit->coulomb_Nm.deviation, fit->viscous_Nms_rad.value, fit->viscous_Nms_rad.deviation,
        fit->delay_periods.value, fit->delay_periods.deviation,
        fit->stiffness_scale ? fit->stiffness_scale->value : 0.0,
        fit->stiffness_scale ? fit->stiffness_scale->deviation : 0.0, fit->load_Nm, fit->load_deviation_Nm,
        fit->remainder_Nm, fit->windows);
}

void show(const Evidence& evidence, const Diagnosis& diagnosis) {
  const Features features = features_of(evidence);
  show_fit(evidence);
  for (std::size_t i = 0; i < kFeatureCount; ++i)
    if (const auto& seen = features.observations[i]; seen && std::abs(seen->normalised()) > 2.0)
      std::fprintf(stderr, "      [%zu] %.2f: %s\n", i, seen->normalised(), seen->text.c_str());
  for (const Finding& finding : diagnosis.findings)
    std::fprintf(stderr, "      -> %s %.2f\n", std::string(finding.cause).c_str(), finding.probability);
  for (const std::string& open : diagnosis.not_judged) std::fprintf(stderr, "      ?? %s\n", open.c_str());
  if (!evidence.samples.empty())
    std::fprintf(stderr, "      last mode %d fault %d at cycle %ld\n", evidence.samples.back().mode,
                 evidence.samples.back().fault, static_cast<long>(evidence.samples.back().cycle));
}

struct Study {
  int joints = 10;  ///< for each cause
  int healthy = 50;
  int first = 0;
  int stride = 1;
  std::string only;  ///< cause; empty: all
};

struct Examined {
  bool right = false;
  double duration_s = 0.0;
};

/// An empty `cause` is a healthy joint.
Examined examine_one(const std::string& cause, int index, const Study& study) {
  Examined examined;
  const Evidence evidence = examine(random_patient(cause, index), study.stride, examined.duration_s);
  const Diagnosis diagnosis = diagnose(evidence);
  const std::vector<Finding>& findings = diagnosis.findings;
  examined.right = cause.empty() ? findings.empty() : !findings.empty() && findings.front().cause == cause;
  if (examined.right && study.only.empty()) return examined;
  static std::mutex showing;
  const std::scoped_lock lock(showing);
  std::fprintf(stderr, "   %s %d: %s\n", cause.empty() ? "healthy" : cause.c_str(), index,
               examined.right ? "right" : "WRONG");
  show(evidence, diagnosis);
  return examined;
}

/// Number of right diagnoses, and duration of the longest test.
std::pair<int, double> examine_all(const std::string& cause, int count, const Study& study) {
  std::vector<Examined> all(static_cast<std::size_t>(count));
  run_in_parallel(all.size(), [&](std::size_t i) {
    all[i] = examine_one(cause, study.first + static_cast<int>(i), study);
  });
  int right = 0;
  double longest_s = 0.0;
  for (const Examined& one : all) {
    right += one.right ? 1 : 0;
    longest_s = std::max(longest_s, one.duration_s);
  }
  return {right, longest_s};
}

void run(const Study& study) {
  TextTable by_cause{"Joints with one cause each", {"cause", "joints", "named first"}, {}};
  int named = 0, all = 0;
  double longest_s = 0.0;
  for (const Cause& cause : causes()) {
    const std::string name(cause.name);
    if (!study.only.empty() && name != study.only) continue;
    const auto [right, duration_s] = examine_all(name, study.joints, study);
    by_cause.rows.push_back({name, std::to_string(study.joints), std::to_string(right)});
    std::fprintf(stderr, "%-30s %d of %d\n", name.c_str(), right, study.joints);
    longest_s = std::max(longest_s, duration_s);
    named += right;
    all += study.joints;
  }
  by_cause.rows.push_back({"all", std::to_string(all), std::to_string(named)});
  const auto [quiet, healthy_s] = examine_all("", study.healthy, study);
  const TextTable healthy{"Healthy joints",
                          {"joints", "alarms", "longest test of all (s)"},
                          {{std::to_string(study.healthy), std::to_string(study.healthy - quiet),
                            number(std::max(longest_s, healthy_s), 3)}}};
  std::cout << by_cause.markdown() << '\n' << healthy.markdown();
}

}  // namespace
}  // namespace strainwave::testing

int main(int argc, char** argv) {
  const auto number = [&](int i, int fallback) { return argc > i ? std::atoi(argv[i]) : fallback; };
  strainwave::testing::run(
      {number(1, 10), number(2, 50), number(3, 0), number(4, 1), argc > 5 ? argv[5] : ""});
}
