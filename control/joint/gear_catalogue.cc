// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/gear_catalogue.h"

#include "base/csv.h"
#include "control/joint/gears_csv.h"

namespace strainwave {

namespace {

std::vector<Gear> read_catalogue() {
  const std::string source = "data/gears.csv";
  const CsvText table = parse_csv_text(kGearsCsv, source);
  table.require_columns({"gear", "ratio", "stiffness_1_Nm_rad", "torque_1_Nm", "stiffness_2_Nm_rad",
                         "torque_2_Nm", "stiffness_3_Nm_rad", "accuracy_rad", "lost_motion_rad",
                         "ratcheting_torque_Nm"});
  std::vector<Gear> gears;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto number = [&](std::size_t column) {
      return parse_number(table.rows[i][column], table.place(i), table.columns[column]);
    };
    gears.push_back({table.rows[i][0],
                     number(1),
                     {number(2), number(3), number(4), number(5), number(6)},
                     number(7),
                     number(8),
                     number(9)});
  }
  return gears;
}

}  // namespace

const std::vector<Gear>& gear_catalogue() {
  static const std::vector<Gear> gears = read_catalogue();
  return gears;
}

std::string gear_names() {
  std::string names;
  for (const Gear& gear : gear_catalogue()) names += (names.empty() ? "" : ", ") + gear.name;
  return names;
}

const Gear* find_gear(std::string_view name) {
  for (const Gear& gear : gear_catalogue())
    if (gear.name == name) return &gear;
  return nullptr;
}

}  // namespace strainwave
