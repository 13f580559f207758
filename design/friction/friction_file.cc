// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_file.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/printable.h"
#include "base/strict_json.h"
#include "base/text_file.h"
#include "control/friction/friction_json.h"
#include "control/units.h"
#include "design/friction/friction_fit.h"
#include "design/friction/sha256.h"

namespace strainwave {

using nlohmann::ordered_json;

namespace {

ordered_json friction_law_to_json(const FrictionLaw& law) {
  return {{"asymptote", friction_parameters_to_json(law.over_temperature.asymptote)},
          {"amplitude", friction_parameters_to_json(law.over_temperature.amplitude)},
          {"reference_C", law.over_temperature.reference_C},
          {"decay_C", law.over_temperature.decay_C},
          {"stribeck_velocity_rad_s", law.stribeck.velocity_rad_s},
          {"stribeck_exponent", law.stribeck.exponent}};
}

// Temperatures of the source's catalogue, Zhao (2006), Table 1.
constexpr double kSourceTemperatureMin_C = -10.0;
constexpr double kSourceTemperatureMax_C = 40.0;

ordered_json record_to_json(const FitRecord& fit) {
  ordered_json residuals = ordered_json::array();
  for (const auto& row : fit.residuals) {
    residuals.push_back({{"temperature_C", row[0]},
                         {"motor_static_Ncm", row[1]},
                         {"motor_coulomb_Ncm", row[2]},
                         {"motor_viscous_Ncm_per_rpm", row[3]}});
  }
  return {{"method", fit.method},
          {"weighting", fit.weighting},
          {"physical", fit.physical},
          {"cost_source", fit.cost_source},
          {"cost_torque", fit.cost_torque},
          {"seed", fit.seed},
          {"generations", fit.generations},
          {"evaluations", fit.evaluations},
          {"stopped", fit.stopped},
          {"best_by_generation", fit.best_by_generation},
          {"residuals", std::move(residuals)}};
}

FitRecord record_from_json(StrictObject object) {
  FitRecord fit;
  fit.method = object.text("method", kMaxTextBytes);
  fit.weighting = object.text("weighting", kMaxTextBytes);
  fit.physical = object.boolean("physical");
  fit.cost_source = object.number("cost_source");
  fit.cost_torque = object.number("cost_torque");
  fit.seed = static_cast<unsigned long long>(object.integer("seed"));
  fit.generations = static_cast<int>(object.integer("generations"));
  fit.evaluations = object.integer("evaluations");
  fit.stopped = object.text("stopped", kMaxTextBytes);
  fit.best_by_generation = object.numbers("best_by_generation");
  for (StrictObject& row : object.objects("residuals", 0, 100000)) {
    fit.residuals.push_back({row.number("temperature_C"), row.number("motor_static_Ncm"),
                             row.number("motor_coulomb_Ncm"), row.number("motor_viscous_Ncm_per_rpm")});
    row.finish();
  }
  object.finish();
  return fit;
}

ordered_json exponential_to_json(const ExponentialFriction& exponential) {
  ordered_json object = friction_law_to_json(exponential.law);
  object["fit"] = record_to_json(exponential.fit);
  return object;
}

ExponentialFriction exponential_from_json(StrictObject object) {
  const FrictionLaw law = friction_law_from_json(object);
  ExponentialFriction exponential{law, record_from_json(object.object("fit"))};
  object.finish();
  return exponential;
}

FuzzyFriction rules_from_csv(const CsvTable& csv, double gear_ratio, GearSide side) {
  // A joint-side table is a motor-side one with ratio 1.
  const double ratio = side == GearSide::kMotor ? gear_ratio : 1.0;
  const std::vector<std::string> columns{"center_C", "width_C", "static_Ncm", "coulomb_Ncm",
                                         "viscous_Ncm_per_rpm"};
  if (std::ranges::find(csv.columns, "temperature_C") != csv.columns.end())
    throw InputError(
        csv.source +
        ": is a catalogue over temperature, not fuzzy rules: strainwave-design fit makes those of it");
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

std::string to_json(const FrictionFile& file) {
  ordered_json document = {{"format", kFrictionFileFormat},
                           {"gear_ratio", file.gear_ratio},
                           {"data_file", file.data_file},
                           {"data_sha256", file.data_sha256}};
  if (file.exponential) document["exponential"] = exponential_to_json(*file.exponential);
  if (file.fuzzy) {
    document["fuzzy"] = {{"friction", fuzzy_friction_to_json(file.fuzzy->friction)},
                         {"fit", record_to_json(file.fuzzy->fit)}};
  }
  if (file.identification) document["identification"] = to_json(*file.identification);
  return document.dump(2) + "\n";
}

FrictionFile friction_file_from_json(const std::string& text, const std::string& source) {
  const ordered_json document = parse_strict_json(text, source);
  StrictObject object(document, source);
  if (object.has("primary"))
    throw InputError(source +
                     ": holds gains, not fitted friction: give the file that strainwave-design fit wrote");
  const long long format = object.integer("format");
  if (format != kFrictionFileFormat) {
    throw InputError(source, "format", std::to_string(format),
                     "this program reads format " + std::to_string(kFrictionFileFormat) + "; fit again");
  }
  FrictionFile file;
  file.gear_ratio = object.number("gear_ratio");
  if (!(file.gear_ratio > 0.0)) throw InputError(object.where("gear_ratio") + ": must be above 0");
  file.data_file = object.text("data_file", kMaxTextBytes);
  file.data_sha256 = object.text("data_sha256", kMaxTextBytes);
  if (object.has("exponential")) file.exponential = exponential_from_json(object.object("exponential"));
  if (object.has("fuzzy")) {
    StrictObject fuzzy = object.object("fuzzy");
    file.fuzzy = FuzzyFrictionRecord{fuzzy_friction_from_json(fuzzy.object("friction")),
                                     record_from_json(fuzzy.object("fit"))};
    fuzzy.finish();
  }
  if (object.has("identification"))
    file.identification = identification_from_json(object.object("identification"));
  object.finish();
  return file;
}

FrictionRules friction_rules_from_json(const std::string& text, const std::string& source,
                                       double gear_ratio) {
  const FrictionFile file = friction_file_from_json(text, source);
  if (!file.fuzzy) throw InputError(source + ": has no fuzzy rules: fit with --model fuzzy or both");
  if (std::abs(file.gear_ratio - gear_ratio) > 1e-9 * gear_ratio) {
    throw InputError(source, "gear_ratio", number_text(file.gear_ratio),
                     "the gains are asked for ratio " + number_text(gear_ratio) + "; use the same in both");
  }
  return {file.fuzzy->friction, sha256_hex(text)};
}

FrictionRules read_friction_rules(const std::filesystem::path& path, double gear_ratio, GearSide csv_side) {
  const std::string text = read_text_file(path);
  if (path.extension() == ".json") return friction_rules_from_json(text, path.string(), gear_ratio);
  return {rules_from_csv(parse_csv(text, path.string()), gear_ratio, csv_side), sha256_hex(text)};
}

}  // namespace strainwave
