// SPDX-License-Identifier: BSD-3-Clause
#include "design/fit_record_command.h"

#include <cmath>
#include <cstdio>
#include <filesystem>

#include "base/input_error.h"
#include "base/text_file.h"
#include "commission/commission_record.h"
#include "design/friction/friction_file.h"
#include "design/friction/friction_update.h"
#include "design/friction/sha256.h"
#include "design/joint_defaults.h"

namespace strainwave {

namespace {

// An estimate is off by half to twice (control/joint/friction_estimate.h). An actuator has the default of fit --log.
constexpr double kEstimateDeviation = 0.5;
constexpr double kNormal95 = 1.96;

std::vector<SteadyPoint> points_of(const CommissionRecord& record, const std::string& source) {
  std::vector<SteadyPoint> points;
  for (const FrictionAtSpeed& at : record.friction) {
    if (!std::isfinite(at.temperature_C))
      throw InputError(source +
                       ": friction: its temperature is not known: connect a sensor and commission again");
    points.push_back({at.temperature_C, at.speed_rad_s, at.torque_Nm.value, 0.0, 0.0});
  }
  if (points.empty())
    throw InputError(source + ": friction: at least one speed must be measured; commission the joint again");
  return points;
}

double deviation_Nm(const CommissionRecord& record) {
  double squares = 0.0;
  for (const FrictionAtSpeed& at : record.friction)
    squares += at.torque_Nm.half_width_95 * at.torque_Nm.half_width_95;
  return std::sqrt(squares / static_cast<double>(record.friction.size())) / kNormal95;
}

double torque_Nm(const FuzzyFriction& friction, const SteadyPoint& at) {
  return stribeck_friction_Nm(friction.blend(friction.weights(at.temperature_C)),
                              friction.velocity.stribeck(), at.speed_rad_s);
}

void report(const std::vector<SteadyPoint>& points, const FuzzyFriction& prior, const FuzzyFriction& used) {
  std::printf("friction in N.m:\n  %10s %6s %10s %10s %10s\n", "rad/s", "degC", "catalogue", "measured",
              "used");
  for (const SteadyPoint& point : points)
    std::printf("  %10.4f %6.1f %10.3f %10.3f %10.3f\n", point.speed_rad_s, point.temperature_C,
                torque_Nm(prior, point), point.friction_Nm, torque_Nm(used, point));
}

}  // namespace

ExitStatus fit_record(const FitRecordOptions& options) {
  const std::string text = read_text_file(options.record);
  const CommissionRecord record = parse_commission_record(text, options.record);
  const std::vector<SteadyPoint> points = points_of(record, options.record);
  const Gear* const gear = find_gear(options.gear);
  if (gear == nullptr) throw InputError("fit", "--gear", options.gear, "must be one of " + gear_names());
  const CatalogueFriction catalogue =
      catalogue_friction(*gear, options.joint_model.empty() ? usual_model(*gear) : options.joint_model);
  UpdateWeights weights;
  if (!catalogue.note.empty()) weights.common = kEstimateDeviation;
  const FrictionUpdate update(catalogue.rules.friction, source_stribeck_shape(gear->ratio), points,
                              deviation_Nm(record), weights);
  report(points, catalogue.rules.friction, update.friction());

  FrictionFile file;
  file.gear_ratio = gear->ratio;
  file.data_file = std::filesystem::path(options.record).filename().string();
  file.data_sha256 = sha256_hex(text);
  file.fuzzy = FuzzyFrictionRecord{update.friction(), {}};
  file.fuzzy->fit.method = "record";
  file.fuzzy->fit.weighting = "bayes";
  file.fuzzy->fit.stopped = "optimum of a linear problem";
  write_text_file(options.out, to_json(file));
  std::printf("%s: written\n", options.out.c_str());
  return ExitStatus::kDone;
}

}  // namespace strainwave
