// SPDX-License-Identifier: BSD-3-Clause
// All of chapter 6 of Zhao (2006): every contender in every scenario, range and setting, and the physical
// limits. Offline; uses all cores; the result does not depend on their number.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sim/studies/contenders.h"
#include "sim/studies/scenarios.h"
#include "sim/studies/time_optimal.h"

namespace strainwave {

/// The place of a run in the tables.
struct Chapter6Key {
  Setting setting = Setting::kIdeal;
  Scenario scenario = Scenario::kStaircase;
  int range = 0;
  bool operator==(const Chapter6Key&) const = default;
};

struct Chapter6Run {
  Chapter6Key key;
  std::string contender;
  ClosedLoopResult result;
};

/// The physical limit of one column. Without a torque limit it would be one sample: PI2 would count each step once.
struct Chapter6Limit {
  Chapter6Key key;
  TimeOptimalResult result;
};

struct Chapter6 {
  std::vector<std::string> contenders;
  std::vector<Chapter6Run> runs;      ///< ordered by key, then by contender
  std::vector<Chapter6Limit> limits;  ///< none for Setting::kIdeal
  double computation_s = 0.0;         ///< wall time of all runs and limits
  long periods = 0;                   ///< simulated plant periods

  /// Throws std::out_of_range if there is no such run.
  const ClosedLoopResult& at(const Chapter6Key& key, const std::string& contender) const;
  const TimeOptimalResult* limit(const Chapter6Key& key) const;
};

/// Runs everything.
Chapter6 run_chapter6(const std::vector<Contender>& contenders);

}  // namespace strainwave
