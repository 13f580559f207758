// SPDX-License-Identifier: BSD-3-Clause
#include "control/table/gain_table.h"

#include <cmath>
#include <type_traits>

#include "base/printable.h"

namespace strainwave {

static_assert(std::is_trivially_copyable_v<GainTable>, "tables are exchanged as bytes");

bool is_same_number(double a, double b) noexcept {
  return std::abs(a - b) <= kAtBound * std::abs(b);
}

std::optional<std::string> find_identity_mismatch(const GainTable& table, const PlantIdentity& expected,
                                                  InertiaCheck inertia) {
  const PlantIdentity& plant = table.plant;
  const auto differs = [](const std::string& key, double value, double wanted) {
    return "plant." + key + " = " + number_text(value) + ": this joint has " + number_text(wanted);
  };
  if (!(plant.joint_model == expected.joint_model)) {
    return "plant.joint_model = " + std::string(plant.joint_model.view()) + ": this joint is a " +
           std::string(expected.joint_model.view());
  }
  const bool both_named = !plant.gear.view().empty() && !expected.gear.view().empty();
  if (both_named && !(plant.gear == expected.gear)) {
    return "plant.gear = " + std::string(plant.gear.view()) + ": this joint has a " +
           std::string(expected.gear.view());
  }
  if (inertia == InertiaCheck::kSame && !is_same_number(plant.inertia_kgm2, expected.inertia_kgm2)) {
    return differs("inertia_kgm2", plant.inertia_kgm2, expected.inertia_kgm2);
  }
  if (!is_same_number(plant.gear_ratio, expected.gear_ratio)) {
    return differs("gear_ratio", plant.gear_ratio, expected.gear_ratio);
  }
  if (!is_same_number(plant.period_s, expected.period_s))
    return differs("period_s", plant.period_s, expected.period_s);
  return std::nullopt;
}

}  // namespace strainwave
