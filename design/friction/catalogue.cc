// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/catalogue.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/nearest_word.h"
#include "base/printable.h"
#include "base/text_file.h"
#include "design/friction/sha256.h"

namespace strainwave {

namespace {

// No strain-wave gear exceeds these limits. They detect wrong units.
constexpr double kMinTemperature_C = -273.15;
constexpr double kMaxTemperature_C = 1000.0;
constexpr double kMaxTorque_Ncm = 1e7;
constexpr double kMaxSpeed_rpm = 1e6;
// Manufacturers print the starting torque at room temperature.
constexpr double kRoom_C = 25.0;
// Static minus Coulomb friction (Zhao 2006, section 2.3).
constexpr double kSourceExcess_Ncm = 1.6;
// If torque is in proportion to speed, the intercept of the line is zero only up to rounding.
constexpr double kRounding_Ncm = 1e-9;

const std::vector<double> kSourceSpeeds_rpm{500.0, 1000.0, 2000.0, 3500.0};

// "torque_500rpm_Ncm" -> 500.
std::optional<double> speed_of_column(const std::string& column) {
  const std::string prefix = "torque_";
  const std::string suffix = "rpm_Ncm";
  if (!column.starts_with(prefix) || !column.ends_with(suffix)) return std::nullopt;
  const char* const first = column.data() + prefix.size();
  const char* const last = column.data() + column.size() - suffix.size();
  double speed = 0.0;
  const auto [end, error] = std::from_chars(first, last, speed);
  if (first >= last || error != std::errc() || end != last || !(speed > 0.0 && speed <= kMaxSpeed_rpm))
    return std::nullopt;
  return speed;
}

struct Line {
  double intercept = 0.0;
  double slope = 0.0;
};

Line least_squares_line(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double covariance = 0.0;
  double variance = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    covariance += (x[i] - mean_x) * (y[i] - mean_y);
    variance += (x[i] - mean_x) * (x[i] - mean_x);
  }
  const double slope = covariance / variance;
  return {mean_y - slope * mean_x, slope};
}

/// Coulomb friction at room temperature, interpolated between rows, or of the nearest row outside of their range.
double coulomb_at_room_Ncm(const std::vector<FrictionPoint>& points) {
  const auto above =
      std::ranges::find_if(points, [](const FrictionPoint& point) { return point.temperature_C >= kRoom_C; });
  if (above == points.end()) return points.back().motor_coulomb_Ncm;
  if (above == points.begin()) return points.front().motor_coulomb_Ncm;
  const auto below = above - 1;
  const double share = (kRoom_C - below->temperature_C) / (above->temperature_C - below->temperature_C);
  return std::lerp(below->motor_coulomb_Ncm, above->motor_coulomb_Ncm, share);
}

/// Sets static friction from the starting torque. No other code converts it.
void set_static_friction(FrictionData& data, const CsvTable& csv, std::optional<std::size_t> starting_column,
                         std::optional<double> starting_torque_Ncm) {
  data.has_starting_torque = starting_column.has_value();
  data.motor_excess_Ncm =
      starting_torque_Ncm ? *starting_torque_Ncm - coulomb_at_room_Ncm(data.points) : kSourceExcess_Ncm;
  for (std::size_t r = 0; r < data.points.size(); ++r) {
    FrictionPoint& point = data.points[r];
    point.motor_static_Ncm =
        starting_column ? csv.rows[r][*starting_column] : point.motor_coulomb_Ncm + data.motor_excess_Ncm;
  }
}

FrictionData from_running_torque(const CsvTable& csv, std::optional<double> starting_torque_Ncm) {
  FrictionData data;
  std::vector<std::size_t> torque_columns;
  std::optional<std::size_t> starting_column;
  const std::size_t temperature_column = csv.column("temperature_C");
  for (std::size_t c = 0; c < csv.columns.size(); ++c) {
    if (c == temperature_column) continue;
    if (csv.columns[c] == "starting_torque_Ncm") {
      starting_column = c;
    } else if (const auto speed = speed_of_column(csv.columns[c])) {
      if (std::ranges::find(data.motor_speeds_rpm, *speed) != data.motor_speeds_rpm.end())
        throw InputError(csv.source + ": column " + csv.columns[c] + ": another column has the same speed");
      torque_columns.push_back(c);
      data.motor_speeds_rpm.push_back(*speed);
    } else {
      throw InputError(csv.source + ": unknown column " + csv.columns[c] +
                       ": allowed are temperature_C, torque_<speed>rpm_Ncm and starting_torque_Ncm." +
                       unit_conversion(csv.columns[c]));
    }
  }
  if (torque_columns.size() < 2)
    throw InputError(csv.source + ": needs torque_<speed>rpm_Ncm at two or more speeds");
  for (std::size_t r = 0; r < csv.rows.size(); ++r) {
    std::vector<double> torques;
    for (const std::size_t c : torque_columns) {
      if (!(csv.rows[r][c] > 0.0 && csv.rows[r][c] <= kMaxTorque_Ncm)) {
        throw InputError(csv.place(r) + ": " + csv.columns[c] +
                         ": running torque must be above 0 and at most 1e7");
      }
      torques.push_back(csv.rows[r][c]);
    }
    const Line line = least_squares_line(data.motor_speeds_rpm, torques);
    data.points.push_back({csv.rows[r][temperature_column], 0.0, line.intercept, line.slope});
  }
  if (!data.points.empty()) set_static_friction(data, csv, starting_column, starting_torque_Ncm);
  return data;
}

FrictionData from_parameters(const CsvTable& csv) {
  const std::size_t temperature = csv.column("temperature_C");
  const std::size_t viscous = csv.column("viscous_Ncm_per_rpm");
  const std::size_t coulomb = csv.column("coulomb_Ncm");
  const std::size_t fixed = csv.column("static_Ncm");
  if (csv.columns.size() != 4)
    throw InputError(csv.source + ": has columns besides temperature and the three parameters");
  FrictionData data;
  data.motor_speeds_rpm = kSourceSpeeds_rpm;
  for (const auto& row : csv.rows)
    data.points.push_back({row[temperature], row[fixed], row[coulomb], row[viscous]});
  data.has_starting_torque = true;
  return data;
}

struct Range {
  const char* name;
  double value, low, high;
  const char* allowed;
};

// Checks that each parameter is in its range, and that static friction is at least Coulomb friction.
void check_point(const FrictionPoint& point, const std::string& where) {
  const std::array<Range, 4> ranges{{
      {"temperature_C", point.temperature_C, kMinTemperature_C, kMaxTemperature_C, "from -273.15 to 1000"},
      {"Coulomb friction (running torque at rest), N.cm", point.motor_coulomb_Ncm, -kRounding_Ncm,
       kMaxTorque_Ncm, "from 0 to 1e7"},
      {"static friction (starting torque), N.cm", point.motor_static_Ncm, point.motor_coulomb_Ncm,
       kMaxTorque_Ncm, "at least the Coulomb friction, which it includes, and at most 1e7"},
      {"viscous friction (slope over speed), N.cm/RPM", point.motor_viscous_Ncm_per_rpm, -kMaxTorque_Ncm,
       kMaxTorque_Ncm, "from -1e7 to 1e7"},
  }};
  for (const Range& range : ranges) {
    if (range.value >= range.low && range.value <= range.high) continue;
    std::ostringstream text;
    text << where << ": " << range.name << " = " << range.value << ": must be " << range.allowed;
    if (range.low == point.motor_coulomb_Ncm) text << "; Coulomb friction is " << range.low;
    throw InputError(text.str());
  }
}

/// Refuses a file whose torque falls with speed at most temperatures. The fit reports single ones as outliers.
void require_rising(const FrictionData& data, const std::string& source) {
  const auto falling = std::ranges::count_if(data.points, [](const FrictionPoint& point) {
    return point.motor_viscous_Ncm_per_rpm < -kRounding_Ncm;
  });
  if (2 * static_cast<std::size_t>(falling) <= data.points.size()) return;
  throw InputError(source + ": torque falls with speed at " + std::to_string(falling) + " of " +
                   std::to_string(data.points.size()) +
                   " temperatures, but the torque of a gear rises: are the columns of the speeds in the "
                   "reverse order, or is a speed below 20 RPM (then leave it out)?");
}

}  // namespace

FrictionData read_catalogue(const std::filesystem::path& path, std::optional<double> starting_torque_Ncm) {
  const std::string text = read_text_file(path);
  const CsvTable csv = parse_csv(text, path.string());
  bool parameters = false;
  for (const std::string& column : csv.columns) parameters = parameters || column == "viscous_Ncm_per_rpm";
  FrictionData data = parameters ? from_parameters(csv) : from_running_torque(csv, starting_torque_Ncm);
  data.sha256 = sha256_hex(text);
  if (data.points.size() < 3)
    throw InputError(
        csv.source + ": holds " + counted(data.points.size(), "temperature") +
        ": at least three are needed. Read more from the catalogue's curve over temperature. If it has no "
        "such curve, multiply the torques of the shipped no_load_torque.csv so "
        "that they match yours at your temperature, and correct the fit with logs of strainwavectl "
        "identify");
  for (std::size_t r = 0; r < data.points.size(); ++r) {
    check_point(data.points[r], csv.place(r));
    if (r > 0 && !(data.points[r - 1].temperature_C < data.points[r].temperature_C)) {
      throw InputError(csv.place(r) + ": temperatures must ascend");
    }
  }
  require_rising(data, csv.source);
  return data;
}

}  // namespace strainwave
