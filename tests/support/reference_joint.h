// SPDX-License-Identifier: BSD-3-Clause
// The joint of Zhao (2006) and the shipped gain tables, for tests.
#pragma once

#include <string>

#include "control/joint/joint_model.h"
#include "control/table/gain_table_json.h"

namespace strainwave::testing {

/// Inertia and gear ratio of the actuator RHS-17-6006, at 1 kHz.
inline PlantIdentity reference_identity() {
  PlantIdentity plant;
  plant.inertia_kgm2 = 0.089;
  plant.gear_ratio = 50.0;
  plant.period_s = 1e-3;
  return plant;
}

/// The same with its friction at about 20 degC.
inline JointModel reference_model() {
  return {reference_identity().inertia_kgm2, {4.4, 3.6, 2.3}, {0.042, 2.0}};
}

/// data/tables/NAME.json.
inline GainTable shipped_table(const std::string& name) {
  return read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/" + name + ".json");
}

}  // namespace strainwave::testing
