// SPDX-License-Identifier: BSD-3-Clause
// The file of a friction fit, which `fit` writes and `gains` reads. Joint side, SI. Offline.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "control/friction/friction.h"
#include "control/friction/fuzzy_friction.h"
#include "design/friction/identification_record.h"

namespace strainwave {

inline constexpr int kFrictionFileFormat = 1;

/// Data minus fit at one temperature, motor side: static and Coulomb (N.cm), viscous friction (N.cm/RPM).
struct FitResidual {
  double temperature_C = 0.0;
  std::array<double, 3> motor{};
};

/// Quality of a fit. Its costs are at the motor side in the catalogue's units (N.cm, N.cm/RPM).
struct FitRecord {
  std::string method;     ///< "least-squares" or "epgs"; "logs", "record": measured, costs are 0
  std::string weighting;  ///< the minimised cost, "source" or "torque"; "bayes" for logs and records
  bool physical = true;   ///< constrained to be non-negative and not increasing with temperature
  double cost_source = 0.0;
  double cost_torque = 0.0;
  unsigned long long seed = 0;
  int generations = 0;           ///< 0 for least squares
  std::int64_t evaluations = 0;  ///< of the cost
  std::string stopped;           ///< reason
  std::vector<double> best_by_generation;
  std::vector<FitResidual> residuals;
};

struct ExponentialFriction {
  FrictionLaw law;
  FitRecord fit;
};
struct FuzzyFrictionRecord {
  FuzzyFriction friction;
  FitRecord fit;
};

struct FrictionFile {
  double gear_ratio = 0.0;
  std::string data_file;
  std::string data_sha256;
  std::optional<ExponentialFriction> exponential;
  std::optional<FuzzyFrictionRecord> fuzzy;
  std::optional<IdentificationRecord> identification;  ///< measured on a joint
};

std::string to_json(const FrictionFile& file);
/// Throws InputError like gain_table_from_json.
FrictionFile friction_file_from_json(const std::string& text, const std::string& source);

enum class GearSide { kMotor, kJoint };

/// Fuzzy rules from `path`: a file of `fit` (.json), or a CSV with center_C, width_C, static_Ncm,
/// coulomb_Ncm, viscous_Ncm_per_rpm. `csv_side` is the side of the gear of the CSV's values. A CSV gets the
/// velocity memberships of Zhao (2006) and the temperature range of its catalogue, -10 to 40 degC.
struct FrictionRules {
  FuzzyFriction friction;
  std::string sha256;
};
FrictionRules read_friction_rules(const std::filesystem::path& path, double gear_ratio, GearSide csv_side);
/// The same from the text of a file of `fit`. Error messages call it `source`.
FrictionRules friction_rules_from_json(const std::string& text, const std::string& source, double gear_ratio);

}  // namespace strainwave
