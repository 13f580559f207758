// SPDX-License-Identifier: BSD-3-Clause
// The result of a friction fit as a file: what `fit` writes and `gains` reads. Joint side, SI. Offline.
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

/// At one temperature the data minus the fit, of static, Coulomb (N.cm) and viscous friction (N.cm/RPM).
struct FitResidual {
  double temperature_C = 0.0;
  std::array<double, 3> motor{};
};

/// How good a fit is; costs at the motor side in the catalogue's units (N.cm, N.cm/RPM).
struct FitRecord {
  std::string method;     ///< "least-squares" or "epgs"; "logs", "record": measured, costs are 0
  std::string weighting;  ///< "source" or "torque": what was minimised; "bayes" for logs
  bool physical = true;   ///< constrained to be non-negative and not increasing with temperature
  double cost_source = 0.0;
  double cost_torque = 0.0;
  unsigned long long seed = 0;
  int generations = 0;           ///< 0 for least squares
  std::int64_t evaluations = 0;  ///< of the cost
  std::string stopped;           ///< why
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
/// Throws InputError as gain_table_from_json does.
FrictionFile friction_file_from_json(const std::string& text, const std::string& source);

enum class GearSide { kMotor, kJoint };

/// Fuzzy rules from `path`: a file of `fit` (.json) or a CSV with center_C, width_C, static_Ncm, coulomb_Ncm,
/// viscous_Ncm_per_rpm at the side of the gear that `csv_side` says. A CSV has the paper's velocity memberships and the temperature range
/// -10 to 40 degC of its catalogue.
struct FrictionRules {
  FuzzyFriction friction;
  std::string sha256;
};
FrictionRules read_friction_rules(const std::filesystem::path& path, double gear_ratio, GearSide csv_side);
/// The same of the text of such a file of `fit`, which messages call `source`.
FrictionRules friction_rules_from_json(const std::string& text, const std::string& source, double gear_ratio);

}  // namespace strainwave
