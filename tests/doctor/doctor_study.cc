// SPDX-License-Identifier: BSD-3-Clause
// The doctor's study: every cause on so many joints, and healthy ones. Prints how many are named first.
//   doctor_study [JOINTS [HEALTHY [STRIDE [CAUSE]]]]
#include <cstdio>
#include <cstdlib>
#include <string>

#include "doctor/causes.h"
#include "doctor/diagnosis.h"
#include "doctor/motion_fit.h"
#include "tests/doctor/patient.h"

namespace strainwave::testing {
namespace {

void show_fit(const Evidence& evidence) {
  if (const auto fit = fit_motion(evidence))
    std::printf(
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
      std::printf("      [%zu] %.2f: %s\n", i, seen->normalised(), seen->text.c_str());
  for (const Finding& finding : diagnosis.findings)
    std::printf("      -> %s %.2f\n", std::string(finding.cause).c_str(), finding.probability);
  for (const std::string& open : diagnosis.not_judged) std::printf("      ?? %s\n", open.c_str());
  if (!evidence.samples.empty())
    std::printf("      last mode %d fault %d at cycle %ld\n", evidence.samples.back().mode,
                evidence.samples.back().fault, static_cast<long>(evidence.samples.back().cycle));
}

int run(int joints, int healthy, int stride, const std::string& only, bool loud) {
  int named = 0, all = 0;
  double longest_s = 0.0;
  for (const Cause& cause : causes()) {
    if (!only.empty() && cause.name != only) continue;
    int right = 0;
    for (int i = 0; i < joints; ++i) {
      double seconds = 0.0;
      const Evidence evidence = examine(random_patient(std::string(cause.name), i), stride, seconds);
      longest_s = std::max(longest_s, seconds);
      const Diagnosis diagnosis = diagnose(evidence);
      const bool is_right = !diagnosis.findings.empty() && diagnosis.findings.front().cause == cause.name;
      right += is_right ? 1 : 0;
      if (!is_right || loud) {
        std::printf("   %s %d: %s\n", std::string(cause.name).c_str(), i, is_right ? "right" : "WRONG");
        show(evidence, diagnosis);
      }
    }
    std::printf("%-30s %d of %d\n", std::string(cause.name).c_str(), right, joints);
    std::fflush(stdout);
    named += right;
    all += joints;
  }
  int alarms = 0;
  for (int i = 0; i < healthy; ++i) {
    double seconds = 0.0;
    const Evidence evidence = examine(random_patient("", i), stride, seconds);
    const Diagnosis diagnosis = diagnose(evidence);
    alarms += diagnosis.findings.empty() ? 0 : 1;
    if (!diagnosis.findings.empty() || loud) {
      std::printf("   healthy %d\n", i);
      show(evidence, diagnosis);
    }
  }
  std::printf("named first: %d of %d; alarms on healthy joints: %d of %d; longest %.1f s\n", named, all,
              alarms, healthy, longest_s);
  return 0;
}

}  // namespace
}  // namespace strainwave::testing

int main(int argc, char** argv) {
  const auto number = [&](int i, int fallback) { return argc > i ? std::atoi(argv[i]) : fallback; };
  return strainwave::testing::run(number(1, 10), number(2, 50), number(3, 1), argc > 4 ? argv[4] : "",
                                  argc > 5);
}
