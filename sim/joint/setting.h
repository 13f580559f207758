// SPDX-License-Identifier: BSD-3-Clause
// The settings of the reference joint, from ideal to realistic. Offline.
#pragma once

#include <array>
#include <string_view>

#include "sim/joint/reference_plant.h"

namespace strainwave {

/// Ideal: exact state, no torque limit (Zhao, 2006). Limited: exact state, peak torque. Realistic: the datasheet.
enum class Setting { kIdeal, kLimited, kRealistic };
inline constexpr std::array kSettings = {Setting::kIdeal, Setting::kLimited, Setting::kRealistic};

constexpr std::string_view name(Setting setting) {
  switch (setting) {
    case Setting::kIdeal:
      return "ideal";
    case Setting::kLimited:
      return "limited";
    case Setting::kRealistic:
      break;
  }
  return "realistic";
}

/// The reference joint in this setting.
inline JointPlantConfig setting_plant(Setting setting) {
  switch (setting) {
    case Setting::kIdeal:
      return ideal_plant();
    case Setting::kLimited:
      return torque_limited_plant();
    case Setting::kRealistic:
      break;
  }
  return realistic_plant();
}

}  // namespace strainwave
