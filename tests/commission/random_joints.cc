// SPDX-License-Identifier: BSD-3-Clause
#include "tests/commission/random_joints.h"

#include <cmath>
#include <numbers>
#include <random>

#include "base/csv.h"
#include "base/units.h"
#include "control/joint/friction_estimate.h"
#include "control/joint/gear_catalogue.h"
#include "sim/joint/reference_plant.h"

namespace strainwave::testing {

namespace {

/// Uniform random numbers, the same on every platform.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : random_(seed) { random_.discard(10); }
  double operator()(double low, double high) {
    return low + (high - low) * std::ldexp(static_cast<double>(random_() >> 11U), -53);
  }

 private:
  std::mt19937_64 random_;
};

void scale(ExponentialTemperatureLaw& law, double factor) {
  for (FrictionParameters* part : {&law.asymptote, &law.amplitude}) {
    part->static_Nm *= factor;
    part->coulomb_Nm *= factor;
    part->viscous_Nms_rad *= factor;
  }
}

/// Friction in proportion to the load: that of gravity, averaged over the range of the strokes at this speed.
double friction_by_load_Nm(const RandomJoint& joint, double speed_rad_s) {
  const JointEffects& effects = joint.drive.plant.effects;
  double best = 1e300;
  double low_rad = 0.0, high_rad = 0.0, from_rad = joint.excitation.start_rad;
  for (const Stroke& stroke : plan_strokes(joint.excitation)) {
    const double off = std::abs(std::log(stroke.speed_rad_s / speed_rad_s));
    if (!stroke.shaken && off <= best) {  // the last stroke at a speed: both directions cover its range
      best = off;
      low_rad = std::min(from_rad, stroke.to_rad);
      high_rad = std::max(from_rad, stroke.to_rad);
    }
    from_rad = stroke.to_rad;
  }
  constexpr int kPlaces = 100;
  double sum = 0.0;
  for (int i = 0; i < kPlaces; ++i)
    sum += std::abs(effects.gravity.at(low_rad + (high_rad - low_rad) * (i + 0.5) / kPlaces));
  return effects.friction.transmitted_share * sum / kPlaces;
}

}  // namespace

RandomJoint random_joint(std::uint64_t seed) {
  Draw draw(seed);
  const std::vector<Gear>& gears = gear_catalogue();
  const Gear& gear = gears[std::min(gears.size() - 1,
                                    static_cast<std::size_t>(draw(0.0, static_cast<double>(gears.size()))))];
  RandomJoint joint;
  joint.gear = gear.name;
  const double N = gear.ratio;
  const double generator = gear.wave_generator_inertia_kgm2 * N * N;
  const double motor = generator * draw(1.2, 2.5);  // wave generator and rotor
  const double link = motor * std::max(0.1, draw(0.0, 3.0));
  joint.told = {N, gear.spring, gear.lost_motion_rad, generator};

  JointPlantConfig& plant = joint.drive.plant;
  plant.joint.inertia_kgm2 = motor;
  const FrictionLaw law = estimate_friction(gear, {reference_joint().friction, reference_joint().stribeck});
  plant.joint.friction = law.over_temperature;
  plant.joint.stribeck = law.stribeck;
  joint.friction_scale = draw(0.5, 1.5);
  scale(plant.joint.friction, joint.friction_scale);
  plant.motor.peak_torque_Nm = gear.repeated_peak_torque_Nm;
  plant.encoder.counts_per_joint_revolution = 4096.0 * N;
  plant.delay.periods = draw(0.5, 2.5);
  plant.delay.jitter_periods = 0.1;
  plant.delay.seed = seed;
  plant.thermal = reference_thermal();
  Transmission gears_spring;
  gears_spring.link_inertia_kgm2 = link;
  gears_spring.spring = gear.spring.scaled(draw(0.8, 1.3));
  gears_spring.damping_Nms_rad =
      structural_damping_Nms_rad(motor, link, gears_spring.spring.stiffness_1_Nm_rad, draw(0.01, 0.05));
  gears_spring.lost_motion.width_rad = gear.lost_motion_rad * draw(0.5, 1.0);
  const double error = draw(0.3, 1.0) * 0.5 * (gear.size < 19.0 ? 0.000436 : 0.000291);
  gears_spring.kinematic_error = {{error, error}, {draw(0.0, 6.28), draw(0.0, 6.28)}};
  plant.effects.transmission = gears_spring;
  plant.effects.gear_ratio = N;
  plant.effects.friction.transmitted_share = draw(0.04, 0.07);
  plant.effects.drive = {draw(0.1e-3, 0.5e-3), 0.02, 12.0};
  const double start = draw(-0.2, 0.2);
  if (draw(0.0, 1.0) < 0.5)
    plant.effects.gravity = {draw(0.0, 0.3) * gear.repeated_peak_torque_Nm * 0.3, start - draw(-0.3, 0.3)};
  plant.initial_position_rad = start;
  joint.drive.ambient = TemperatureProfile::constant(draw(-10.0, 45.0));
  joint.drive.seed = seed;

  const double motor_speed = draw(900.0, 2000.0);
  joint.excitation.limits = {start - draw(0.35, 0.7), start + draw(0.35, 0.7),
                             joint_velocity_rad_s_from_motor_rpm(motor_speed, N), 3.0,
                             gear.repeated_peak_torque_Nm};
  joint.excitation.encoder_resolution_rad = kTurn_rad / plant.encoder.counts_per_joint_revolution;
  joint.excitation.gear_ratio = N;
  joint.excitation.motor_inertia_kgm2 = generator;
  joint.excitation.start_rad = start;
  return joint;
}

CommissionedJoint excite(const RandomJoint& joint) {
  SimulatedActuator drive(joint.drive);
  Excitation excitation(joint.excitation);
  CommissionedJoint run;
  std::int64_t now_ns = 0;
  constexpr int kLongest = 300'000;
  for (int k = 0; k < kLongest && !excitation.ended(); ++k, now_ns += 1'000'000) {
    const ActuatorReading reading = drive.read(now_ns);
    const ActuatorCommand command = excitation.step(reading);
    drive.write(command);
    const auto& state = drive.plant().state();
    const ExcitationLimits& limits = joint.excitation.limits;
    run.most_speed_rad_s = std::max(run.most_speed_rad_s, std::abs(state.velocity_rad_s));
    const bool inside = state.position_rad >= limits.position_min_rad &&
                        state.position_rad <= limits.position_max_rad &&
                        std::abs(state.velocity_rad_s) <= limits.speed_rad_s &&
                        std::abs(command.torque_Nm) <= limits.torque_Nm;
    run.violations += inside ? 0 : 1;
    run.faults += reading.fault == ActuatorFault::kNone ? 0 : 1;
  }
  run.duration_s = 1e-9 * static_cast<double>(now_ns);
  run.problem = excitation.ended() ? excitation.problem() : "did not end";
  run.trace = excitation.trace();
  return run;
}

std::vector<Comparison> compare(const RandomJoint& joint, const JointEstimates& found) {
  const JointPlantConfig& plant = joint.drive.plant;
  const Transmission& gear = *plant.effects.transmission;
  std::vector<Comparison> all;
  const auto add = [&](const char* quantity, double truth, const std::optional<IntervalEstimate>& estimate) {
    all.push_back({quantity, truth, estimate.value_or(IntervalEstimate{}), !estimate});
  };
  const std::optional<MotionEstimates>& m = found.motion;
  const double K = gear.spring.stiffness_1_Nm_rad;
  const double motor = plant.joint.inertia_kgm2;
  add("resonance", free_free_frequency_rad_s(motor, gear.link_inertia_kgm2, K) / kTurn_rad,
      m ? m->resonance_Hz : std::nullopt);
  add("stiffness", K, m ? m->stiffness_1_Nm_rad : std::nullopt);
  add("link inertia", gear.link_inertia_kgm2, m ? m->link_inertia_kgm2 : std::nullopt);
  add("motor inertia", motor, m ? m->motor_inertia_kgm2 : std::nullopt);
  add("total inertia", motor + gear.link_inertia_kgm2,
      m ? std::optional(m->total_inertia_kgm2) : std::nullopt);
  add("delay",
      (plant.delay.periods + 0.5 * plant.delay.jitter_periods) * plant.period_s +
          plant.effects.drive.current_loop_s,
      m ? std::optional(m->delay_s) : std::nullopt);
  if (plant.effects.gravity.torque_Nm > 0.0)
    add("gravity", plant.effects.gravity.torque_Nm, m ? std::optional(m->gravity_Nm) : std::nullopt);
  for (const FrictionAtSpeed& point : found.friction) {
    const FrictionParameters f = plant.joint.friction.at(point.temperature_C);
    add("friction",
        friction_by_load_Nm(joint, point.speed_rad_s) +
            stribeck_friction_Nm(f, plant.joint.stribeck, point.speed_rad_s),
        point.torque_Nm);
  }
  return all;
}

}  // namespace strainwave::testing
