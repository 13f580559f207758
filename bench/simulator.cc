// SPDX-License-Identifier: BSD-3-Clause
// Measures the speed of the simulated joint: sub-steps of its physics and whole periods of the plant. Read `items_per_second`.
#include <benchmark/benchmark.h>

#include <cmath>

#include "sim/joint/joint_plant.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/loop_controllers.h"

namespace strainwave {
namespace {

constexpr int kSubsteps = 10;

/// Moves back and forth up to a speed. 0.1 rad/s stays in the Stribeck range, where each slope needs an exponential.
void physics_substep(benchmark::State& bench) {
  const JointParameters joint = reference_joint();
  JointInput input;
  input.friction = joint.friction.at(-10.0);
  input.motor = MotorLimits::from_motor(reference_motor());
  JointState state;
  const double speed_rad_s = static_cast<double>(bench.range(0)) * 1e-3;
  input.torque_Nm = 10.0;
  for (auto _ : bench) {
    if (std::abs(state.velocity_rad_s) > speed_rad_s)
      input.torque_Nm = -std::copysign(10.0, state.velocity_rad_s);
    advance(state, joint, input, 1e-4, kSubsteps);
    benchmark::DoNotOptimize(state);
  }
  bench.SetItemsProcessed(bench.iterations() * kSubsteps);
}
BENCHMARK(physics_substep)->Arg(100)->Arg(3000)->ArgName("speed_mrad_s");

/// One period of the closed loop with the realistic plant and a PID controller, which keeps the joint moving.
void plant_period(benchmark::State& bench) {
  JointPlantConfig config = realistic_plant();
  config.substeps = kSubsteps;
  JointPlant plant(config);
  PidLoopController pid({}, config.period_s);
  LoopSample sample;
  long k = 0;
  for (auto _ : bench) {
    plant.set_ambient_temperature(15.0 + 25.0 * std::sin(plant.time_s()));
    sample.setpoint_position_rad = (k++ / 500) % 2 == 0 ? 0.1 : -0.1;
    sample.joint_position_rad = plant.measured_position_rad();
    plant.step(pid.torque_Nm(sample));
  }
  bench.SetItemsProcessed(bench.iterations());
}
BENCHMARK(plant_period);

/// One period of the flexible joint under an alternating torque, without and with all effects.
void flexible_plant_period(benchmark::State& bench) {
  JointPlantConfig config = flexible_plant();
  if (bench.range(0) != 0) {
    Transmission& gear = *config.effects.transmission;
    gear.lost_motion.width_rad = 5.8e-4;
    gear.kinematic_error = {{2.2e-4, 2.2e-4}, {0.0, 1.0}};
    gear.link_coulomb_Nm = 0.3;
    config.effects.friction.transmitted_share = 0.06;
    config.effects.drive = {5e-4, 0.02, 12.0};
  }
  JointPlant plant(config);
  plant.set_ambient_temperature(20.0);
  long k = 0;
  for (auto _ : bench) plant.step((k++ / 100) % 2 == 0 ? 15.0 : -15.0);
  bench.SetItemsProcessed(bench.iterations());
}
BENCHMARK(flexible_plant_period)->Arg(0)->Arg(1)->ArgName("every_effect");

}  // namespace
}  // namespace strainwave

BENCHMARK_MAIN();
