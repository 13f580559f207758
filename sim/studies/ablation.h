// SPDX-License-Identifier: BSD-3-Clause
// What each part of the controller is worth: every study with that part switched off (control/mechanism.h). A part that changes no figure by
// 5 % is not in the product. Offline; uses all cores; the result does not depend on how many.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "control/mechanism.h"
#include "sim/studies/flexible_study.h"
#include "sim/studies/text_table.h"

namespace strainwave {

/// kNone, and what may be switched off.
inline constexpr std::array kMechanisms = {
    Mechanism::kNone,         Mechanism::kWindUp,     Mechanism::kFriction,    Mechanism::kFrictionLearning,
    Mechanism::kLoadLearning, Mechanism::kRestTorque, Mechanism::kCorrections, Mechanism::kPace,
    Mechanism::kGivingWay};

/// "wind-up in the plan" and so on.
std::string_view name_of(Mechanism mechanism) noexcept;

struct AblationRow {
  Mechanism without = Mechanism::kNone;
  std::array<double, 4> step_sums{};  ///< grid, median of the link's sum |e / r| at 0.001, 0.01, 0.1, 1 rad
  double overshoot_rad = 0.0;         ///< grid, worst of links up to 0.267 kg m2
  double rest_torque_Nm = 0.0;        ///< grid, largest at rest, 95 %
  double unsettled = 0.0;             ///< grid, cells that do not settle, oscillate or are switched off
  double wrong_off = 0.0;  ///< joints configured wrongly: at rest off by more than 40 urad, or switched off
  double wrong_worst_rad = 0.0;      ///< the farthest at rest of them that are not switched off
  double wrong_overshoot_rad = 0.0;  ///< likewise
  double random_rest_rad = 0.0;      ///< joints at random, half of them wrong: error at rest, 95 %
  double load_rest_rad = 0.0;  ///< grid with a load of 5 N.m that is not configured: error at rest, 95 %
  double first_rms_rad = 0.0;  ///< streamed motions at -10 to 45 degC, mean of RMS, first run
  double sixth_rms_rad = 0.0;  ///< the same, the sixth run
};

/// `random` joints are drawn with `seed`.
AblationRow run_without(Mechanism without, const FlexibleTables& tables, int random, std::uint64_t seed);

/// How much each figure grows without the part: the first of `rows` is kNone's. The last column is the largest growth.
TextTable ablation_table(const std::vector<AblationRow>& rows);

/// By how much the figure that suffers most grows, as a share.
double worth(const AblationRow& without, const AblationRow& complete) noexcept;

}  // namespace strainwave
