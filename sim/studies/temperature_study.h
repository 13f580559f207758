// SPDX-License-Identifier: BSD-3-Clause
// What it is worth to know the temperature: ways to compensate friction, each on the joint with a spring. The joint is cold or warm, moves
// or tracks slowly, its sensor is right or wrong, at the first move and at the hundredth. Every way follows the same path; what counts is
// the link's distance from it. Offline; uses all cores; the result does not depend on how many. Source: docs/why-temperature.md.
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

/// A way to meet friction.
struct FrictionWay {
  std::string name;
  /// For a joint, a path and a sensor that reads so much too high (NaN: it is missing).
  std::function<std::unique_ptr<LoopController>(const JointPlantConfig&, const SmoothPath&, double shift_C)>
      make;
};

/// "none": the law without integral and friction; "integral alone": with integral, what the product is without any friction; "fixed":
/// friction of 30 degC; "disturbance observer"; "scheduled" by temperature, without integral; "scheduled and integral": as the
/// product is. All but the disturbance observer are the daemon's controller, which differ in nothing else.
std::vector<FrictionWay> friction_ways(const FlexibleTables& tables);

/// The last of them without a part of the controller.
FrictionWay product_way_without(const FlexibleTables& tables, Mechanism without);

/// The table of the last of them.
const GainTable& study_table(const FlexibleTables& tables);

/// How wrong the sensor is.
struct SensorFault {
  std::string name;
  double shift_C;  ///< what it reads too much; NaN: it is missing
};
/// Right, late by 15 minutes while the surroundings warm by 20 degC an hour, 10 degC off either way, missing.
std::vector<SensorFault> sensor_faults();

struct PathMotion {
  std::string name;
  SmoothPath path;
  double last_begins_s = 0.0;  ///< its last repetition
};
/// There and back by 0.01, 0.1, 1 rad; to and fro at 0.01, 0.1, 1 rad/s; each so many times, >= 1.
std::vector<PathMotion> study_motions(int times = 1);
inline constexpr int kLearnedAfter = 6;  ///< the same motion for the sixth time

/// The flexible joint of the study: link 0.1 kg m2, 2 % damping.
JointPlantConfig temperature_plant();

inline constexpr std::array<double, 6> kStudyTemperatures_C = {-10.0, 0.0, 10.0, 20.0, 30.0, 45.0};

/// Of the link from the path, over a stretch of time.
struct PathError {
  double rms_rad = 0.0;
  double peak_rad = 0.0;
};

struct PathRun {
  std::vector<PathError> stretches;  ///< one per stretch that was asked for
  bool switched_off = false;
};

/// Runs `way` on `path` from rest in surroundings of `temperature_C`; the path's time is cut at `ends_s`, ascending. Throws InputError
/// when the loop diverges.
PathRun run_path(const JointPlantConfig& plant, const FrictionWay& way, const SmoothPath& path,
                 const SensorFault& sensor, double temperature_C, const std::vector<double>& ends_s);

struct TemperatureRow {
  std::string way, sensor, motion;
  double temperature_C = 0.0;
  PathError error;
  bool switched_off = false;
};

/// Every way at every temperature with the right sensor, and `sensors` besides with the last way: the last of so many motions.
std::vector<TemperatureRow> run_temperatures(const std::vector<FrictionWay>& ways,
                                             const std::vector<SensorFault>& sensors, int times = 1);

/// The last of `ways` (which is given `table`) and "none" on joints whose friction at each temperature is the very one that `table`
/// declares: what of the error is not friction's.
std::vector<TemperatureRow> run_friction_known(const std::vector<FrictionWay>& ways, const GainTable& table);

/// A hundred moves there and back by `step_rad`, one a second, from a night at `temperature_C` on; the joint warms by its losses.
/// The error of each move, its hold included.
std::vector<PathError> run_hundred_moves(const FrictionWay& way, double step_rad, double temperature_C);

}  // namespace strainwave
