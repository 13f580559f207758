// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/joint_catalogue.h"

#include <algorithm>
#include <cmath>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/units.h"
#include "control/joint/catalogue_csv.h"

namespace strainwave {

namespace {

std::vector<CatalogueJoint::Point> read_points() {
  const CsvTable table = parse_csv(kFrictionCsv, "data/friction_parameters.csv");
  table.require_columns({"temperature_C", "viscous_Ncm_per_rpm", "coulomb_Ncm", "static_Ncm"});
  std::vector<CatalogueJoint::Point> points;
  for (const std::vector<double>& row : table.rows)
    points.push_back(
        {row[0], {row[3] * kNmPerNcm, row[2] * kNmPerNcm, row[1] * kNmPerNcm / kRadPerSecondPerRpm}});
  return points;
}

// The number that the data sheet gives for `quantity`.
double read_datasheet(const std::string& quantity) {
  const std::string source = "data/rhs17_datasheet.csv";
  const CsvText table = parse_csv_text(kDatasheetCsv, source);
  table.require_columns({"quantity", "value", "unit", "note"});
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i][0] == quantity) return parse_number(table.rows[i][1], table.place(i), quantity);
  throw InputError(source + ": " + quantity + " is missing");
}

}  // namespace

FrictionParameters CatalogueJoint::friction_at(double temperature_C, double gear_ratio) const noexcept {
  const double at_C = std::clamp(temperature_C, points.front().temperature_C, points.back().temperature_C);
  std::size_t above = 1;
  while (points[above].temperature_C < at_C) ++above;
  const Point& cold = points[above - 1];
  const Point& warm = points[above];
  const double share = (at_C - cold.temperature_C) / (warm.temperature_C - cold.temperature_C);
  const FrictionParameters& from = cold.motor_friction;
  const FrictionParameters& to = warm.motor_friction;
  return {gear_ratio * std::lerp(from.static_Nm, to.static_Nm, share),
          gear_ratio * std::lerp(from.coulomb_Nm, to.coulomb_Nm, share),
          gear_ratio * gear_ratio * std::lerp(from.viscous_Nms_rad, to.viscous_Nms_rad, share)};
}

const CatalogueJoint& catalogue_joint() {
  // Its gear is of size 17 and ratio 50 (data/README.md).
  static const CatalogueJoint joint{"rhs17-6006", "csf-17-50", read_datasheet("inertia_at_output"),
                                    read_points()};
  return joint;
}

}  // namespace strainwave
