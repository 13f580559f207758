// SPDX-License-Identifier: BSD-3-Clause
// Record of how the friction of a file was measured on a joint. It is part of the friction file. Joint side.
// Offline.
#pragma once

#include <string>
#include <vector>

#include "design/friction/friction_regression.h"
#include "design/friction/friction_update.h"

namespace strainwave {

struct IdentificationRecord {
  std::string prior_file;
  std::string prior_sha256;
  UpdateWeights weights;
  double noise_Nm = 0.0;                     ///< standard deviation of a point
  double confidence = 0.0;                   ///< of the intervals
  std::vector<FrictionRegression> measured;  ///< one per temperature
};

}  // namespace strainwave
