// bench/controller: what the control law of one joint costs beside the exponentials that it cannot avoid.
// The law: six rules, integrator, friction compensation. Exponentials per step: five memberships over temperature (when the
// temperature is new) and one over velocity. Both sides are timed in alternating slices of one run; the ratio is the figure.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <vector>

#include "control/gain_table_json.h"
#include "control/joint_controller.h"
#include "control/scheduled_controller.h"

namespace strainwave {
namespace {

constexpr int kSteps = 20'000;
constexpr int kSlices = 200;

double seconds(auto&& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

volatile double sink;

double exponentials(int per_step) {
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k)
    for (int i = 0; i < per_step; ++i) sum += std::exp(-1e-4 * (k % 977) - 0.1 * i);
  return sum;
}

ControllerInput input_at(int k) {
  ControllerInput input;
  input.joint_position_rad = 1e-3 * (k % 100);
  input.joint_velocity_rad_s = 1e-2 * (k % 37);
  input.torque_limit_Nm = 34.0;
  return input;
}

double law(ScheduledController& controller, int temperature_every) {
  double sum = 0.0;
  for (int k = 0; k < kSteps; ++k) {
    if (k % temperature_every == 0) controller.set_temperature(-10.0 + 0.05 * (k % 1000));
    sum += controller.step(input_at(k)).torque_Nm;
  }
  return sum;
}

double median(std::vector<double>& values) {
  std::nth_element(values.begin(), values.begin() + static_cast<long>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

void compare(const char* name, int temperature_every, double exponentials_per_step) {
  const GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json");
  ScheduledController controller(table.primary, table.friction, table.plant);
  std::vector<double> law_ns;
  std::vector<double> exp_ns;
  constexpr int kExponentials = 6;
  for (int slice = 0; slice < kSlices; ++slice) {
    law_ns.push_back(1e9 / kSteps * seconds([&] { sink = law(controller, temperature_every); }));
    exp_ns.push_back(1e9 / kSteps / kExponentials * seconds([&] { sink = exponentials(kExponentials); }));
  }
  const double law_median_ns = median(law_ns);
  const double unavoidable_ns = exponentials_per_step * median(exp_ns);
  std::printf("%-44s %8.1f ns  %5.1f exp = %6.1f ns  ratio %.2f\n", name, law_median_ns, exponentials_per_step,
              unavoidable_ns, law_median_ns / unavoidable_ns);
}

}  // namespace
}  // namespace strainwave

int main() {
  strainwave::compare("law, new temperature every step", 1, 6.0);
  strainwave::compare("law, new temperature every 10th step", 10, 1.5);
  return 0;
}
