// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/joint_catalogue.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/csv.h"
#include "base/input_error.h"
#include "control/joint/catalogue_csv.h"
#include "control/units.h"

namespace strainwave {

namespace {

// Of the catalogue's. What is identified on joints with a third more friction than the catalogue's, in rules that blend otherwise over
// speed than friction does, comes to 1.7 times.
constexpr double kMostDeclaredFriction = 2.0;
// Where it is looked at: thousandths of the table's range of temperature besides the rules' centres, and from a tenth of the Stribeck
// velocity to more than the joint's highest speed (8.4 rad/s).
constexpr int kTemperatures = 1000;
constexpr double kSlowest_rad_s = 0.004;
constexpr double kFastest_rad_s = 10.0;
constexpr double kSpeedStep = 1.1;

std::vector<CatalogueJoint::Point> read_points() {
  const CsvTable table = parse_csv(kFrictionCsv, "data/friction_parameters.csv");
  table.require_columns({"temperature_C", "viscous_Ncm_per_rpm", "coulomb_Ncm", "static_Ncm"});
  std::vector<CatalogueJoint::Point> points;
  for (const std::vector<double>& row : table.rows)
    points.push_back(
        {row[0], {row[3] * kNmPerNcm, row[2] * kNmPerNcm, row[1] * kNmPerNcm / kRadPerSecondPerRpm}});
  return points;
}

// The data sheet's one number for `quantity`.
double read_datasheet(const std::string& quantity) {
  const std::string source = "data/rhs17_datasheet.csv";
  const CsvText table = parse_csv_text(kDatasheetCsv, source);
  table.require_columns({"quantity", "value", "unit", "note"});
  for (std::size_t i = 0; i < table.rows.size(); ++i)
    if (table.rows[i][0] == quantity) return parse_number(table.rows[i][1], table.place(i), quantity);
  throw InputError(source + ": " + quantity + " is missing");
}

std::vector<double> temperatures_of(const FuzzyFriction& friction) {
  std::vector<double> temperatures_C;
  for (int i = 0; i <= kTemperatures; ++i)
    temperatures_C.push_back(std::lerp(friction.temperature_min_C, friction.temperature_max_C,
                                       static_cast<double>(i) / kTemperatures));
  for (std::size_t i = 0; i < static_cast<std::size_t>(friction.rule_count); ++i)
    temperatures_C.push_back(
        std::clamp(friction.rules[i].center_C, friction.temperature_min_C, friction.temperature_max_C));
  return temperatures_C;
}

struct Place {
  double temperature_C = 0.0;
  double velocity_rad_s = 0.0;
  double torque_Nm = 0.0;
  double own_Nm = 1.0;
};

// NaN exceeds everything.
bool exceeds(const Place& place, const Place& worst) noexcept {
  return !(place.torque_Nm * worst.own_Nm <= worst.torque_Nm * place.own_Nm);
}

std::string excess(const Place& place, const CatalogueJoint& joint) {
  std::array<char, 256> text{};
  std::snprintf(
      text.data(), text.size(),
      "friction = %.4g N.m at %.4g degC and %.4g rad/s: must be at most %.4g, %.3g times that of %s: "
      "compensated, it would drive the joint",
      place.torque_Nm, place.temperature_C, place.velocity_rad_s, kMostDeclaredFriction * place.own_Nm,
      kMostDeclaredFriction, joint.model.c_str());
  return text.data();
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

const std::vector<CatalogueJoint>& joint_catalogue() {
  // Its gear is of size 17 and ratio 50 (data/README.md).
  static const std::vector<CatalogueJoint> joints{
      {"rhs17-6006", "csf-17-50", read_datasheet("inertia_at_output"), read_points()}};
  return joints;
}

const CatalogueJoint* find_catalogue_joint(std::string_view model) {
  for (const CatalogueJoint& joint : joint_catalogue())
    if (joint.model == model) return &joint;
  return nullptr;
}

const CatalogueJoint* find_catalogue_joint_with_gear(std::string_view gear) {
  for (const CatalogueJoint& joint : joint_catalogue())
    if (joint.gear == gear) return &joint;
  return nullptr;
}

StribeckShape source_stribeck_shape(double gear_ratio) {
  return {joint_velocity_rad_s_from_motor_rpm(20.0, gear_ratio), 2.0};
}

std::optional<std::string> find_excess_friction(const FuzzyFriction& friction, const CatalogueJoint& joint,
                                                double gear_ratio) {
  const StribeckShape shape = source_stribeck_shape(gear_ratio);
  Place worst;
  for (const double temperature_C : temperatures_of(friction)) {
    const FrictionParameters declared = friction.blend(friction.weights(temperature_C));
    const FrictionParameters own = joint.friction_at(temperature_C, gear_ratio);
    const Place at_rest{temperature_C, 0.0, declared.static_Nm, own.static_Nm};
    if (exceeds(at_rest, worst)) worst = at_rest;
    for (double speed = kSlowest_rad_s; speed < kFastest_rad_s; speed *= kSpeedStep) {
      const Place here{temperature_C, speed, friction.torque_Nm(declared, speed),
                       stribeck_friction_Nm(own, shape, speed)};
      if (exceeds(here, worst)) worst = here;
    }
  }
  if (worst.torque_Nm <= kMostDeclaredFriction * worst.own_Nm) return std::nullopt;
  return excess(worst, joint);
}

}  // namespace strainwave
