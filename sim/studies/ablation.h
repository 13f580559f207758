// SPDX-License-Identifier: BSD-3-Clause
// The contribution of each part of the controller: every study with that part switched off (control/mechanism.h). All parts but one
// change a figure by 5 % (docs/results/ablation.md). Offline; uses all cores; the result does not depend on their number.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "control/mechanism.h"
#include "sim/studies/flexible_study.h"
#include "sim/studies/text_table.h"

namespace strainwave {

/// kNone, and the parts that can be switched off.
inline constexpr std::array kMechanisms = {
    Mechanism::kNone,         Mechanism::kWindUp,     Mechanism::kFriction,    Mechanism::kFrictionLearning,
    Mechanism::kLoadLearning, Mechanism::kRestTorque, Mechanism::kCorrections, Mechanism::kPace,
    Mechanism::kGivingWay};

/// The name of the part, such as "wind-up in the plan".
std::string_view name_of(Mechanism mechanism) noexcept;

struct AblationRow {
  Mechanism without = Mechanism::kNone;
  std::array<double, 4> step_sums{};  ///< grid, median of the link's sum |e / r| at 0.001, 0.01, 0.1, 1 rad
  double overshoot_rad = 0.0;         ///< grid, worst with links up to 0.267 kg m2
  double rest_torque_Nm = 0.0;        ///< grid, 95th percentile of the largest torque at rest
  double unsettled = 0.0;             ///< grid, cells that do not settle, oscillate or are switched off
  double wrong_off = 0.0;  ///< wrong configuration: joints off by more than 40 urad at rest, or switched off
  double wrong_worst_rad = 0.0;      ///< the same: largest error at rest, without joints switched off
  double wrong_overshoot_rad = 0.0;  ///< the same: largest overshoot, without joints switched off
  double random_rest_rad = 0.0;      ///< random joints, half of them wrong: 95th percentile of error at rest
  double load_rest_rad = 0.0;  ///< grid with unknown gravity, m g l = 5 N.m: 95th percentile of error at rest
  double first_rms_rad = 0.0;  ///< streamed motions at -10 to 45 degC: mean RMS error of the first run
  double sixth_rms_rad = 0.0;  ///< the same motions: mean RMS error of the sixth run
};

/// Runs every study without one part; `random` joints are drawn with `seed`.
AblationRow run_without(Mechanism without, const FlexibleTables& tables, int random, std::uint64_t seed);

/// The figures of each row. The last column is their largest growth over the first row, which is that of kNone.
TextTable ablation_table(const std::vector<AblationRow>& rows);

/// Relative growth of the figure that grows most without the part.
double worth(const AblationRow& without, const AblationRow& complete) noexcept;

}  // namespace strainwave
