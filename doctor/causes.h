// SPDX-License-Identifier: BSD-3-Clause
// What can be wrong with a joint, and which features each cause predicts. docs/doctor.md has the same table. Not real-time.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "doctor/features.h"

namespace strainwave {

/// A cause of size lambda moves the features of `moves` by lambda times their factor, all together. Those of `explains` it may move by any
/// amount.
struct Cause {
  std::string_view name;
  std::string_view remedy;
  std::vector<std::pair<Feature, double>> moves;
  std::vector<Feature> explains;
  double least = -3.0, most = 3.0;  ///< lambda
  bool by_temperature = false;      ///< lambda is an error in degC, and friction follows the table
  bool by_catalogue = false;        ///< lambda leads to a ratio that gears have
};

const std::vector<Cause>& causes();

}  // namespace strainwave
