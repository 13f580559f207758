// SPDX-License-Identifier: BSD-3-Clause
// The benefit of a known temperature: ways to compensate friction, each on the joint with a spring. The joint is cold or warm, moves or
// tracks slowly, with a right or wrong sensor, at the first move and at the hundredth. Every way follows the same path, and the link's
// distance from it counts. Offline; uses all cores; the result does not depend on their number. Source: docs/why-temperature.md.
#pragma once

#include <array>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "sim/studies/contenders.h"
#include "sim/studies/flexible_study.h"
#include "sim/studies/smooth_path.h"

namespace strainwave {

/// A way to compensate friction.
struct FrictionWay {
  std::string name;
  /// Makes the controller for a joint, a path, and a sensor that reads too high by `shift_C` (NaN: missing).
  std::function<std::unique_ptr<LoopController>(const JointPlantConfig&, const SmoothPath&, double shift_C)>
      make;
};

/// "none": the law without integral and friction. "integral alone": the product without friction. "fixed
/// friction": that of 30 degC. "scheduled": by temperature, without integral. "scheduled and integral": the
/// product. All but the "disturbance observer" are the daemon's controller, and differ in nothing else.
std::vector<FrictionWay> friction_ways(const FlexibleTables& tables);

/// The last of these ways, without a part of the controller.
FrictionWay product_way_without(const FlexibleTables& tables, Mechanism without);

/// The gain table of the last of these ways.
const GainTable& study_table(const FlexibleTables& tables);

/// The error of the temperature sensor.
struct SensorFault {
  std::string name;
  double shift_C;  ///< added to the reading; NaN: the sensor is missing
};
/// Right, late by 15 minutes while the surroundings warm by 20 degC an hour, 10 degC off in either direction, missing.
std::vector<SensorFault> sensor_faults();

struct PathMotion {
  std::string name;
  SmoothPath path;
  double last_begins_s = 0.0;  ///< start of its last repetition
};
/// Moves there and back by 0.01, 0.1, 1 rad; motions to and fro at 0.01, 0.1, 1 rad/s; each repeated `times` >= 1.
std::vector<PathMotion> study_motions(int times = 1);
inline constexpr int kLearnedAfter = 6;  ///< the sixth run of a motion counts as learned

/// The flexible joint of the study: link 0.1 kg m2, 2 % damping.
JointPlantConfig temperature_plant();

inline constexpr std::array<double, 6> kStudyTemperatures_C = {-10.0, 0.0, 10.0, 20.0, 30.0, 45.0};

/// Distance of the link from the path, over a stretch of time.
struct PathError {
  double rms_rad = 0.0;
  double peak_rad = 0.0;
};

struct PathRun {
  std::vector<PathError> stretches;  ///< one per end in `ends_s`
  bool switched_off = false;
};

/// Runs `way` on `path` from rest in surroundings of `temperature_C`. The ascending `ends_s` divide the time
/// into stretches. Throws InputError if the loop diverges.
PathRun run_path(const JointPlantConfig& plant, const FrictionWay& way, const SmoothPath& path,
                 const SensorFault& sensor, double temperature_C, const std::vector<double>& ends_s);

struct TemperatureRow {
  std::string way, sensor, motion;
  double temperature_C = 0.0;
  PathError error;
  bool switched_off = false;
};

/// Runs every way at every temperature with the right sensor, and the last way also with `sensors`. Rows are the last of `times` runs.
std::vector<TemperatureRow> run_temperatures(const std::vector<FrictionWay>& ways,
                                             const std::vector<SensorFault>& sensors, int times = 1);

/// Runs the last of `ways`, which has `table`, and "none". The joints have exactly the friction that `table`
/// declares at each temperature, so that friction does not cause the remaining error.
std::vector<TemperatureRow> run_friction_known(const std::vector<FrictionWay>& ways, const GainTable& table);

/// Runs a hundred moves there and back by `step_rad`, one per second, from `temperature_C` after a night.
/// Losses warm the joint. Returns the error of each move, including its hold.
std::vector<PathError> run_hundred_moves(const FrictionWay& way, double step_rad, double temperature_C);

}  // namespace strainwave
