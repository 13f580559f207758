#include "design/catalogue.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <sstream>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/text_file.h"
#include "design/sha256.h"

namespace strainwave {

namespace {

// Beyond these no gear of this kind exists; they catch wrong units.
constexpr double kMinTemperature_C = -273.15;
constexpr double kMaxTemperature_C = 1000.0;
constexpr double kMaxTorque_Ncm = 1e7;
constexpr double kMaxSpeed_rpm = 1e6;
// A line through torques in proportion to speed ends at zero only up to rounding.
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

FrictionData from_running_torque(const CsvTable& csv, double starting_torque_Ncm) {
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
        throw InputError(csv.source + ": column " + csv.columns[c] +
                         ": there is another one of the same speed");
      torque_columns.push_back(c);
      data.motor_speeds_rpm.push_back(*speed);
    } else {
      throw InputError(csv.source + ": unknown column " + csv.columns[c] +
                       ": allowed are temperature_C, torque_<speed>rpm_Ncm and starting_torque_Ncm");
    }
  }
  if (torque_columns.size() < 2)
    throw InputError(csv.source + ": needs torque_<speed>rpm_Ncm at two or more speeds");
  data.has_starting_torque = starting_column.has_value();
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
    const double starting = starting_column ? csv.rows[r][*starting_column] : starting_torque_Ncm;
    data.points.push_back(
        {csv.rows[r][temperature_column], line.intercept + starting, line.intercept, line.slope});
  }
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

// Friction is friction: each in its range, static at least Coulomb.
void check_point(const FrictionPoint& point, const std::string& where) {
  const std::array<Range, 4> ranges{{
      {"temperature_C", point.temperature_C, kMinTemperature_C, kMaxTemperature_C, "from -273.15 to 1000"},
      {"Coulomb friction (running torque at rest), N.cm", point.motor_coulomb_Ncm, -kRounding_Ncm,
       kMaxTorque_Ncm, "from 0 to 1e7"},
      {"static friction (Coulomb and starting torque), N.cm", point.motor_static_Ncm, point.motor_coulomb_Ncm,
       kMaxTorque_Ncm, "from the Coulomb friction to 1e7"},
      {"viscous friction (slope over speed), N.cm/RPM", point.motor_viscous_Ncm_per_rpm, -kMaxTorque_Ncm,
       kMaxTorque_Ncm, "from -1e7 to 1e7"},
  }};
  for (const Range& range : ranges) {
    if (range.value >= range.low && range.value <= range.high) continue;
    std::ostringstream text;
    text << where << ": " << range.name << " = " << range.value << ": must be " << range.allowed;
    throw InputError(text.str());
  }
}

}  // namespace

FrictionData read_catalogue(const std::filesystem::path& path, double starting_torque_Ncm) {
  const std::string text = read_text_file(path);
  const CsvTable csv = parse_csv(text, path.string());
  bool parameters = false;
  for (const std::string& column : csv.columns) parameters = parameters || column == "viscous_Ncm_per_rpm";
  FrictionData data = parameters ? from_parameters(csv) : from_running_torque(csv, starting_torque_Ncm);
  data.sha256 = sha256_hex(text);
  if (data.points.size() < 3) throw InputError(csv.source + ": needs at least three temperatures");
  for (std::size_t r = 0; r < data.points.size(); ++r) {
    check_point(data.points[r], csv.place(r));
    if (r > 0 && !(data.points[r - 1].temperature_C < data.points[r].temperature_C)) {
      throw InputError(csv.place(r) + ": temperatures must ascend");
    }
  }
  return data;
}

}  // namespace strainwave
