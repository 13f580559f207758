// SPDX-License-Identifier: BSD-3-Clause
// A table of data/ for a joint of another inertia.
#pragma once

#include <string>

#include "control/table/gain_table_json.h"

namespace strainwave::testing {

/// The table of `data/tables/NAME` with gains in proportion to the inertia. A rigid joint then has the same closed loop.
inline GainTable scaled_table(const std::string& name, double inertia_kgm2) {
  GainTable table = read_gain_table(STRAINWAVE_SOURCE_DIR "/data/tables/" + name);
  const double scale = inertia_kgm2 / table.plant.inertia_kgm2;
  table.plant.inertia_kgm2 = inertia_kgm2;
  for (int rule = 0; rule < table.primary.rule_count; ++rule)
    table.primary.set(rule, scale * table.primary.gain(rule), table.primary.lyapunov(rule));
  return table;
}

}  // namespace strainwave::testing
