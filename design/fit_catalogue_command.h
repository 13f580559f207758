// SPDX-License-Identifier: BSD-3-Clause
// `strainwave-design fit CATALOGUE` fits friction over temperature to the manufacturer's catalogue, and warns
// of doubtful data. Offline.
#pragma once

#include <optional>
#include <string>

#include "strainwave/exit_status.h"

namespace strainwave {

struct FitCatalogueOptions {
  std::string catalogue;
  std::string out;
  std::string model = "both";
  std::string method = "epgs";
  std::string weighting = "torque";
  bool unconstrained = false;
  std::string non_increasing = "curve";
  std::string rules_from = "auto";
  std::string outliers = "keep";
  unsigned long long seed = 1;
  int threads = 0;
  int rules = 5;
  double gear_ratio = 50.0;
  std::optional<double> starting_torque_Ncm;  ///< at 25 degC, see read_catalogue()
};

/// Fits, reports and writes the friction file. Returns the exit status. Throws InputError.
ExitStatus fit_catalogue(const FitCatalogueOptions& options);

}  // namespace strainwave
