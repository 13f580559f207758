// SPDX-License-Identifier: BSD-3-Clause
// bench/controller: the cost of the control law of one joint, relative to its unavoidable exponentials. The
// law has six rules (five over temperature, one for zero velocity) and an integrator, for a joint that
// follows a sine. It needs five exponentials for the memberships when the temperature is new, and one over
// velocity in each step. They are timed with the same arguments as in the law. Both sides run in alternating
// slices; the result is the ratio of the medians.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "control/scheduled_controller.h"
#include "control/table/gain_table_json.h"

namespace strainwave {
namespace {

constexpr int kSamples = 1000;
constexpr int kPasses = 20;
constexpr int kSlices = 400;

volatile double sink;

/// Mean time of one sample, in ns.
double ns_per_sample(auto&& work) {
  const auto start = std::chrono::steady_clock::now();
  for (int pass = 0; pass < kPasses; ++pass) sink = work();
  const std::chrono::duration<double, std::nano> elapsed = std::chrono::steady_clock::now() - start;
  return elapsed.count() / (kPasses * kSamples);
}

double temperature_C(int sample) {
  return -10.0 + 0.05 * sample;
}

std::vector<ControllerInput> sine(bool jumps) {
  std::vector<ControllerInput> inputs(kSamples);
  for (int k = 0; k < kSamples; ++k) {
    ControllerInput& input = inputs[static_cast<std::size_t>(k)];
    const double phase = 2.0 * std::numbers::pi * k / kSamples;
    input.setpoint_position_rad = std::sin(phase);
    input.setpoint_velocity_rad_s = 2.0 * std::numbers::pi * std::cos(phase);
    input.joint_position_rad = input.setpoint_position_rad + 1e-4 * std::sin(7.0 * phase + 0.3);
    input.joint_velocity_rad_s = input.setpoint_velocity_rad_s + 1e-3 * std::cos(7.0 * phase);
    input.torque_limit_Nm = 34.0;
    if (jumps) input.jumped_from_rad = std::sin(phase - 2.0 * std::numbers::pi / kSamples);
    input.feedforward_torque_Nm = 5.0 * std::sin(3.0 * phase);
  }
  return inputs;
}

double law(ScheduledController& controller, const std::vector<ControllerInput>& inputs,
           int temperature_every) {
  double sum = 0.0;
  for (int k = 0; k < kSamples; ++k) {
    if (k % temperature_every == 0) controller.set_temperature(temperature_C(k));
    sum += controller.step(inputs[static_cast<std::size_t>(k)]).torque_Nm;
  }
  return sum;
}

/// The arguments that the law passes to exp over those samples.
std::vector<double> arguments_of_law(const FuzzyFriction& friction,
                                     const std::vector<ControllerInput>& inputs, int temperature_every) {
  std::vector<double> arguments;
  for (int k = 0; k < kSamples; ++k) {
    if (k % temperature_every == 0) {
      const TemperatureWeights weights = friction.weights(temperature_C(k));
      const double largest =
          *std::max_element(weights.weight.begin(), weights.weight.begin() + weights.count);
      for (int i = 0; i < weights.count; ++i)
        arguments.push_back(std::log(weights.weight[static_cast<std::size_t>(i)] / largest));
    }
    const double zero_weight =
        friction.velocity.zero_weight(inputs[static_cast<std::size_t>(k)].joint_velocity_rad_s);
    arguments.push_back(std::log(1.0 / zero_weight - 1.0));
  }
  return arguments;
}

double exponentials(const std::vector<double>& arguments) {
  double sum = 0.0;
  for (const double argument : arguments) sum += std::exp(argument);
  return sum;
}

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

void compare(const char* name, bool jumps, int temperature_every) {
  const GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/rhs17-6006.json");
  ScheduledController controller(table.primary, table.friction, table.plant);
  const std::vector<ControllerInput> inputs = sine(jumps);
  const std::vector<double> arguments = arguments_of_law(table.friction, inputs, temperature_every);
  std::vector<double> law_ns;
  std::vector<double> exponentials_ns;
  for (int slice = 0; slice < kSlices; ++slice) {
    law_ns.push_back(ns_per_sample([&] { return law(controller, inputs, temperature_every); }));
    exponentials_ns.push_back(ns_per_sample([&] { return exponentials(arguments); }));
  }
  std::printf("%-52s %6.1f ns   its %3.1f exponentials %6.1f ns   ratio %.2f\n", name, median(law_ns),
              static_cast<double>(arguments.size()) / kSamples, median(exponentials_ns),
              median(law_ns) / median(exponentials_ns));
}

}  // namespace
}  // namespace strainwave

int main() {
  strainwave::compare("planned motion, new temperature every step", false, 1);
  strainwave::compare("a setpoint jump and a new temperature every step", true, 1);
  strainwave::compare("planned motion, new temperature every 10th step", false, 10);
  return 0;
}
