// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/temperature_study.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/input_error.h"
#include "base/parallel.h"
#include "sim/joint/reference_plant.h"
#include "sim/studies/path_follower.h"
#include "sim/studies/peers/disturbance_observer.h"
#include "sim/studies/text_table.h"

namespace strainwave {

namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kLinkInertia_kgm2 = 0.1;
constexpr double kTotalInertia_kgm2 = kReferenceInertia_kgm2 + kLinkInertia_kgm2;
constexpr double kDamping = 0.02;
constexpr double kFixed_C = 30.0;
constexpr double kOff_C = 10.0;
// The sensor lags by a quarter of an hour, in a hall that is heated in the morning.
constexpr double kLate_h = 0.25;
constexpr double kWarming_C_h = 20.0;
// Less than half of the acceleration that the actuator can give this link.
constexpr double kAcceleration_rad_s2 = 20.0;
constexpr double kBegin_s = 0.05;
constexpr double kHold_s = 0.3;
constexpr double kCruise_s = 1.0;
constexpr double kReversal_s = 0.1;
constexpr int kMoves = 100;

GainTable without_friction(GainTable table) {
  for (TemperatureRule& rule : table.friction.rules) rule.friction = {0.0, 0.0, 0.0};
  return table;
}

FrictionWay product_way(const std::string& name, const GainTable& table, const StreamedController::Told& told,
                        Mechanism without = Mechanism::kNone) {
  return {name,
          [table, told, without](const JointPlantConfig& plant, const SmoothPath& path, double shift_C) {
            StreamedController::Told now = told;
            now.shift_C += shift_C;
            JointControllerConfig config = extended_config(plant, table);
            config.without = without;
            return std::make_unique<StreamedController>(config, table, path, now);
          }};
}

FrictionWay observer_way() {
  return {"disturbance observer", [](const JointPlantConfig& plant, const SmoothPath& path, double) {
            const ServoJoint joint = servo_joint(plant);
            return std::make_unique<PeerOnPath>(std::make_unique<DisturbanceObserverPeer>(joint), joint,
                                                path);
          }};
}

void go_there_and_back(double step_rad, SmoothPath& path) {
  for (const double target_rad : {step_rad, 0.0}) {
    path.move_to(target_rad, kAcceleration_rad_s2);
    path.go_on(kHold_s);
  }
}

void go_to_and_fro(double velocity_rad_s, SmoothPath& path) {
  double last_rad_s = 0.0;
  for (const double next_rad_s : {velocity_rad_s, -velocity_rad_s, velocity_rad_s, 0.0}) {
    path.change_velocity(next_rad_s, 1.5 * std::abs(next_rad_s - last_rad_s) / kReversal_s);
    path.go_on(next_rad_s == 0.0 ? kHold_s : kCruise_s);
    last_rad_s = next_rad_s;
  }
}

PathMotion repeated(const std::string& name, const std::function<void(SmoothPath&)>& go, int times) {
  PathMotion motion{name, SmoothPath(kBegin_s)};
  for (int i = 0; i < times; ++i) {
    if (i > 0) motion.last_begins_s = motion.path.end_s();
    go(motion.path);
  }
  return motion;
}

struct Job {
  const FrictionWay* way;
  const SensorFault* sensor;
  const PathMotion* motion;
  double temperature_C;
};

std::vector<TemperatureRow> run_jobs(const std::vector<Job>& jobs,
                                     const std::function<JointPlantConfig(double temperature_C)>& plant_at) {
  std::vector<TemperatureRow> rows(jobs.size());
  run_in_parallel(jobs.size(), [&](std::size_t i) {
    const Job& job = jobs[i];
    const SmoothPath& path = job.motion->path;
    const PathRun run = run_path(plant_at(job.temperature_C), *job.way, path, *job.sensor, job.temperature_C,
                                 {job.motion->last_begins_s, path.end_s()});
    rows[i] = {job.way->name,     job.sensor->name,     job.motion->name,
               job.temperature_C, run.stretches.back(), run.switched_off};
  });
  return rows;
}

}  // namespace

const GainTable& study_table(const FlexibleTables& tables) {
  return FlexibleTables::nearest(tables.c4, kTotalInertia_kgm2);
}

std::vector<FrictionWay> friction_ways(const FlexibleTables& tables) {
  const GainTable& c1 = FlexibleTables::nearest(tables.c1, kTotalInertia_kgm2);
  const GainTable& c2 = FlexibleTables::nearest(tables.c2, kTotalInertia_kgm2);
  const GainTable& c4 = study_table(tables);
  const StreamedController::Told nothing{{}, kNaN};
  return {product_way("none", without_friction(c1), nothing),
          product_way("integral alone", without_friction(c4), nothing),
          product_way("fixed friction", c4, {kFixed_C, 0.0}),
          observer_way(),
          product_way("scheduled", c2, {}),
          product_way("scheduled and integral", c4, {})};
}

FrictionWay product_way_without(const FlexibleTables& tables, Mechanism without) {
  return product_way("without", study_table(tables), {}, without);
}

std::vector<SensorFault> sensor_faults() {
  return {{"right", 0.0},
          {"15 min late", -kLate_h * kWarming_C_h},
          {"10 degC too high", kOff_C},
          {"10 degC too low", -kOff_C},
          {"missing", kNaN}};
}

std::vector<PathMotion> study_motions(int times) {
  std::vector<PathMotion> motions;
  for (const double step_rad : {0.01, 0.1, 1.0})
    motions.push_back(repeated(
        "move " + number(step_rad, 3) + " rad", [=](SmoothPath& path) { go_there_and_back(step_rad, path); },
        times));
  for (const double velocity_rad_s : {0.01, 0.1, 1.0})
    motions.push_back(repeated(
        "track " + number(velocity_rad_s, 3) + " rad/s",
        [=](SmoothPath& path) { go_to_and_fro(velocity_rad_s, path); }, times));
  return motions;
}

JointPlantConfig temperature_plant() {
  JointPlantConfig plant = flexible_plant();
  Transmission& gear = *plant.effects.transmission;
  gear.link_inertia_kgm2 = kLinkInertia_kgm2;
  gear.damping_Nms_rad = structural_damping_Nms_rad(plant.joint.inertia_kgm2, kLinkInertia_kgm2,
                                                    gear.spring.stiffness_1_Nm_rad, kDamping);
  return plant;
}

PathRun run_path(const JointPlantConfig& plant, const FrictionWay& way, const SmoothPath& path,
                 const SensorFault& sensor, double temperature_C, const std::vector<double>& ends_s) {
  ClosedLoopConfig loop;
  loop.plant = plant;
  loop.ambient = TemperatureProfile::constant(temperature_C);
  loop.duration_s = ends_s.back();
  const auto controller = way.make(plant, path, sensor.shift_C);
  PathRun run;
  run.stretches.resize(ends_s.size());
  std::vector<long> counts(ends_s.size());
  std::size_t stretch = 0;
  const bool stable = simulate(loop, *controller, [&](const TracePoint& point) {
    while (stretch + 1 < ends_s.size() && point.time_s >= ends_s[stretch]) ++stretch;
    const double error_rad = std::abs(path.at(point.time_s).position_rad - point.link_position_rad);
    PathError& error = run.stretches[stretch];
    error.rms_rad += error_rad * error_rad;
    error.peak_rad = std::max(error.peak_rad, error_rad);
    ++counts[stretch];
  });
  if (!stable) throw InputError("temperature: the loop is unstable (" + way.name + ")");
  for (std::size_t i = 0; i < counts.size(); ++i)
    run.stretches[i].rms_rad = std::sqrt(run.stretches[i].rms_rad / static_cast<double>(counts[i]));
  run.switched_off = controller->switched_off();
  return run;
}

std::vector<TemperatureRow> run_temperatures(const std::vector<FrictionWay>& ways,
                                             const std::vector<SensorFault>& sensors, int times) {
  const std::vector<PathMotion> motions = study_motions(times);
  const SensorFault right = sensor_faults().front();
  std::vector<Job> jobs;
  for (const double temperature_C : kStudyTemperatures_C)
    for (const PathMotion& motion : motions) {
      for (const FrictionWay& way : ways) jobs.push_back({&way, &right, &motion, temperature_C});
      for (const SensorFault& sensor : sensors)
        if (sensor.name != right.name) jobs.push_back({&ways.back(), &sensor, &motion, temperature_C});
    }
  return run_jobs(jobs, [](double) { return temperature_plant(); });
}

std::vector<TemperatureRow> run_friction_known(const std::vector<FrictionWay>& ways, const GainTable& table) {
  const std::vector<PathMotion> motions = study_motions();
  const SensorFault right = sensor_faults().front();
  std::vector<Job> jobs;
  for (const double temperature_C : kStudyTemperatures_C)
    for (const PathMotion& motion : motions)
      for (const FrictionWay* way : {&ways.front(), &ways.back()})
        jobs.push_back({way, &right, &motion, temperature_C});
  return run_jobs(jobs, [&table](double temperature_C) {
    return with_declared_friction(temperature_plant(), table, temperature_C);
  });
}

std::vector<PathError> run_hundred_moves(const FrictionWay& way, double step_rad, double temperature_C) {
  SmoothPath path(kBegin_s);
  std::vector<double> ends_s;
  for (int move = 0; move < kMoves; ++move) {
    path.move_to(move % 2 == 0 ? step_rad : 0.0, kAcceleration_rad_s2);
    path.go_on(kBegin_s + move + 1.0 - path.end_s());
    ends_s.push_back(path.end_s());
  }
  JointPlantConfig plant = temperature_plant();
  plant.thermal = reference_thermal();
  return run_path(plant, way, path, sensor_faults().front(), temperature_C, ends_s).stretches;
}

}  // namespace strainwave
