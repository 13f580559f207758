// SPDX-License-Identifier: BSD-3-Clause
// Possible causes of a joint's problems, and the features that each predicts. docs/doctor.md has the same table. Not real-time.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "doctor/features.h"

namespace strainwave {

/// A cause of size lambda changes all features in `moves` by lambda times their factors. It may change those in `explains` by any
/// amount.
struct Cause {
  std::string_view name;
  std::string_view remedy;
  std::vector<std::pair<Feature, double>> moves;
  std::vector<Feature> explains;
  double least = -3.0, most = 3.0;  ///< range of lambda
  bool by_temperature = false;      ///< lambda is an error in degC, and friction follows the table
  bool by_catalogue = false;        ///< lambda must lead to an existing gear ratio
};

const std::vector<Cause>& causes();

}  // namespace strainwave
