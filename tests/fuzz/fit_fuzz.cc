// SPDX-License-Identifier: BSD-3-Clause
// Any catalogue is refused, or fitted with finite numbers. Any file of fitted friction is refused, or is the same after it is written and
// read again.
#include <algorithm>
#include <string>

#include "base/input_error.h"
#include "design/friction/catalogue.h"
#include "design/friction/fit_checks.h"
#include "design/friction/friction_file.h"
#include "design/friction/friction_fit.h"
#include "tests/fuzz/fuzz_file.h"

namespace {

void fit(const strainwave::FrictionData& data) {
  using namespace strainwave;
  const FitProblem problem{fit_targets(data), friction_metric(FitWeighting::kTorque, data.motor_speeds_rpm),
                           true};
  const double low_C = data.points.front().temperature_C;
  const double high_C = data.points.back().temperature_C;
  const ExponentialFit law = fit_exponential(problem, 1.0, std::max(2.0, 10.0 * (high_C - low_C)));
  STRAINWAVE_FUZZ_CHECK(predict(law, problem.targets.temperature_C).allFinite());
  const Memberships memberships = graded_memberships(3, low_C, high_C);
  const FuzzyFit rules = fit_consequents(problem, memberships.center_C, memberships.width_C);
  STRAINWAVE_FUZZ_CHECK(predict(rules, problem.targets.temperature_C).allFinite());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace strainwave;
  try {
    if (size > 0 && data[0] == '{') {
      const std::string json = to_json(friction_file_from_json(std::string(data, data + size), "fit.json"));
      STRAINWAVE_FUZZ_CHECK(to_json(friction_file_from_json(json, "written.json")) == json);
    } else {
      const fuzz::FuzzFile file(data, size);
      fit(read_catalogue(file.path()));
    }
  } catch (const InputError&) {
    // Refused, which is right for most inputs.
  }
  return 0;
}
