// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/gear_catalogue.h"

#include "base/csv.h"
#include "base/input_error.h"
#include "base/units.h"
#include "control/joint/catalogue_csv.h"

namespace strainwave {

namespace {

// The size in a name: 17 in "csf-17-50".
double size_of(const std::string& name, const std::string& place) {
  const std::vector<std::string_view> parts = split(name, '-');
  if (parts.size() != 3) throw InputError(place, "gear", name, "must be SERIES-SIZE-RATIO");
  return parse_number(parts[1], place, "gear");
}

std::vector<Gear> read_catalogue() {
  const CsvText table = parse_csv_text(kGearsCsv, "data/gears.csv");
  std::vector<Gear> gears;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const auto text = [&](const char* column) { return table.rows[i][table.column(column)]; };
    const auto number = [&](const char* column) {
      return parse_number(text(column), table.place(i), column);
    };
    const auto known_Nm = [&](const char* column) {
      return text(column).empty() ? std::nullopt : std::optional(kNmPerNcm * number(column));
    };
    gears.push_back({text("gear"),
                     size_of(text("gear"), table.place(i)),
                     number("ratio"),
                     {number("stiffness_1_Nm_rad"), number("torque_1_Nm"), number("stiffness_2_Nm_rad"),
                      number("torque_2_Nm"), number("stiffness_3_Nm_rad")},
                     number("lost_motion_rad"),
                     number("repeated_peak_torque_Nm"),
                     number("wave_generator_inertia_kgm2"),
                     known_Nm("running_torque_Ncm"),
                     known_Nm("starting_torque_Ncm")});
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
