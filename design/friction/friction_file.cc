// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_file.h"

#include <algorithm>
#include <cmath>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/json_fields.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "base/units.h"
#include "control/friction/friction_json.h"
#include "design/friction/friction_fit.h"
#include "design/friction/sha256.h"

namespace strainwave {

namespace {

// Temperature range of the catalogue in Zhao (2006), Table 1.
constexpr double kSourceTemperatureMin_C = -10.0;
constexpr double kSourceTemperatureMax_C = 40.0;

FuzzyFriction rules_from_csv(const CsvTable& csv, double gear_ratio, GearSide side) {
  // Values at the joint side convert like those at the motor side with ratio 1.
  const double ratio = side == GearSide::kMotor ? gear_ratio : 1.0;
  const std::vector<std::string> columns{"center_C", "width_C", "static_Ncm", "coulomb_Ncm",
                                         "viscous_Ncm_per_rpm"};
  if (std::ranges::find(csv.columns, "temperature_C") != csv.columns.end())
    throw InputError(
        csv.source +
        ": is a catalogue over temperature, not fuzzy rules: fit the rules to it with strainwave-design fit");
  std::vector<std::size_t> index;
  index.reserve(columns.size());
  for (const std::string& column : columns) index.push_back(csv.column(column));
  if (csv.columns.size() != columns.size())
    throw InputError(csv.source + ": has columns besides those of fuzzy rules");
  if (csv.rows.size() > kMaxTemperatureRules) {
    throw InputError(csv.source + ": has " + std::to_string(csv.rows.size()) + " rules, at most " +
                     std::to_string(kMaxTemperatureRules) + " are possible");
  }
  FuzzyFit fit;
  const auto count = static_cast<Eigen::Index>(csv.rows.size());
  fit.center_C.resize(count);
  fit.width_C.resize(count);
  fit.consequents.resize(count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& row = csv.rows[static_cast<std::size_t>(i)];
    fit.center_C(i) = row[index[0]];
    fit.width_C(i) = row[index[1]];
    fit.consequents.row(i) << row[index[2]], row[index[3]], row[index[4]];
    const std::string where = csv.place(static_cast<std::size_t>(i));
    if (!(fit.width_C(i) > 0.0)) throw InputError(where + ": width_C must be above 0");
    if (i > 0 && !(fit.center_C(i - 1) < fit.center_C(i))) throw InputError(where + ": centres must ascend");
    if (!(fit.consequents.row(i).minCoeff() >= 0.0))
      throw InputError(where + ": friction must not be negative");
  }
  FuzzyFriction friction = to_joint_side(fit, ratio, kSourceTemperatureMin_C, kSourceTemperatureMax_C);
  friction.velocity = source_velocity_memberships(gear_ratio);
  return friction;
}

}  // namespace

template <typename Json>
void fields(Json& json, FitRecord& fit) {
  json("method", fit.method);
  json("weighting", fit.weighting);
  json("physical", fit.physical);
  json("cost_source", fit.cost_source);
  json("cost_torque", fit.cost_torque);
  json("seed", fit.seed);
  json("generations", fit.generations);
  json.require(fit.generations >= 0, "generations", "0 or more");
  json("evaluations", fit.evaluations);
  json.require(fit.evaluations >= 0, "evaluations", "0 or more");
  json("stopped", fit.stopped);
  json("best_by_generation", fit.best_by_generation);
  json("residuals", fit.residuals);
}

template <typename Json>
void fields(Json& json, FitResidual& residual) {
  json("temperature_C", residual.temperature_C);
  json("motor_static_Ncm", residual.motor[0]);
  json("motor_coulomb_Ncm", residual.motor[1]);
  json("motor_viscous_Ncm_per_rpm", residual.motor[2]);
}

template <typename Json>
void fields(Json& json, ExponentialFriction& exponential) {
  fields(json, exponential.law);
  json("fit", exponential.fit);
}

template <typename Json>
void fields(Json& json, FuzzyFrictionRecord& fuzzy) {
  json("friction", fuzzy.friction);
  json("fit", fuzzy.fit);
}

template <typename Json>
void fields(Json& json, FrictionRegression& fit) {
  json("temperature_C", fit.temperature_C);
  json("points", fit.points);
  json("static_Nm", fit.static_Nm.value);
  json("static_half_width_Nm", fit.static_Nm.half_width);
  json("coulomb_Nm", fit.coulomb_Nm.value);
  json("coulomb_half_width_Nm", fit.coulomb_Nm.half_width);
  json("viscous_Nms_rad", fit.viscous_Nms_rad.value);
  json("viscous_half_width_Nms_rad", fit.viscous_Nms_rad.half_width);
  json("residual_squares", fit.residual_squares);
  json("degrees_of_freedom", fit.degrees_of_freedom);
}

template <typename Json>
void fields(Json& json, IdentificationRecord& record) {
  json("prior_file", record.prior_file);
  json("prior_sha256", record.prior_sha256);
  json("prior_common_deviation", record.weights.common);
  json("prior_own_deviation", record.weights.own);
  json("torque_uncertainty", record.weights.torque_uncertainty);
  json("noise_Nm", record.noise_Nm);
  json("confidence", record.confidence);
  json("measured", record.measured);
}

template <typename Json>
void fields(Json& json, FrictionFile& file) {
  json.refuse("primary", "holds gains, not fitted friction: give the file that strainwave-design fit wrote");
  json.format(kFrictionFileFormat, "fit again");
  json("gear_ratio", file.gear_ratio);
  json.require(file.gear_ratio > 0.0, "gear_ratio", "above 0");
  json("data_file", file.data_file);
  json("data_sha256", file.data_sha256);
  json("exponential", file.exponential);
  json("fuzzy", file.fuzzy);
  json("identification", file.identification);
}

std::string to_json(const FrictionFile& file) {
  return json_text(file);
}

FrictionFile friction_file_from_json(const std::string& text, const std::string& source) {
  return from_json_text<FrictionFile>(text, source);
}

FrictionRules friction_rules_from_json(const std::string& text, const std::string& source,
                                       double gear_ratio) {
  const FrictionFile file = friction_file_from_json(text, source);
  if (!file.fuzzy) throw InputError(source + ": has no fuzzy rules: fit with --model fuzzy or both");
  if (std::abs(file.gear_ratio - gear_ratio) > 1e-9 * gear_ratio) {
    throw InputError(source, "gear_ratio", number_text(file.gear_ratio),
                     "must be the ratio of the gains, " + number_text(gear_ratio));
  }
  return {file.fuzzy->friction, sha256_hex(text)};
}

FrictionRules read_friction_rules(const std::filesystem::path& path, double gear_ratio, GearSide csv_side) {
  const std::string text = read_text_file(path);
  if (path.extension() == ".json") return friction_rules_from_json(text, path.string(), gear_ratio);
  return {rules_from_csv(parse_csv(text, path.string()), gear_ratio, csv_side), sha256_hex(text)};
}

}  // namespace strainwave
