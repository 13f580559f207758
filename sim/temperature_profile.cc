#include "sim/temperature_profile.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "control/input_error.h"
#include "sim/csv.h"

namespace strainwave {

namespace {

const std::string kWhere = "temperature profile";
constexpr double kAbsoluteZero_C = -273.15;

double checked_temperature(double temperature_C, const std::string& where) {
  if (!(std::isfinite(temperature_C) && temperature_C > kAbsoluteZero_C))
    throw InputError(where, "temperature_C", std::to_string(temperature_C),
                     "must be finite and above -273.15");
  return temperature_C;
}

double checked_finite(double value, const std::string& key) {
  if (!std::isfinite(value)) throw InputError(kWhere, key, std::to_string(value), "must be finite");
  return value;
}

}  // namespace

TemperatureProfile TemperatureProfile::constant(double temperature_C) {
  TemperatureProfile profile;
  profile.base_C_ = checked_temperature(temperature_C, kWhere);
  return profile;
}

TemperatureProfile TemperatureProfile::steps(double start_C, double rise_C, double interval_s, double count) {
  if (!(std::isfinite(interval_s) && interval_s > 0.0))
    throw InputError(kWhere, "interval_s", std::to_string(interval_s), "must be finite and > 0");
  if (!(count >= 1.0 && count == std::floor(count) && std::isfinite(count)))
    throw InputError(kWhere, "count", std::to_string(count), "must be a whole number >= 1");
  TemperatureProfile profile;
  profile.kind_ = Kind::kSteps;
  profile.base_C_ = checked_temperature(start_C, kWhere);
  profile.change_C_ = checked_finite(rise_C, "rise_C");
  profile.rate_ = interval_s;
  profile.count_ = count;
  checked_temperature(start_C + rise_C * count, kWhere);
  return profile;
}

TemperatureProfile TemperatureProfile::sine(double mean_C, double amplitude_C,
                                            double angular_frequency_rad_s) {
  TemperatureProfile profile;
  profile.kind_ = Kind::kSine;
  profile.base_C_ = mean_C;
  profile.change_C_ = checked_finite(amplitude_C, "amplitude_C");
  profile.rate_ = checked_finite(angular_frequency_rad_s, "angular_frequency_rad_s");
  checked_temperature(mean_C - std::abs(amplitude_C), kWhere);
  return profile;
}

TemperatureProfile TemperatureProfile::from_csv(const std::filesystem::path& path) {
  TemperatureProfile profile;
  profile.kind_ = Kind::kPoints;
  for (const CsvRow& row : read_csv(path, {"time_s", "temperature_C"})) {
    const std::string where = path.string() + ":" + std::to_string(row.line);
    if (!profile.points_.empty() && row.values[0] <= profile.points_.back().time_s)
      throw InputError(where, "time_s", std::to_string(row.values[0]),
                       "must be greater than in the row before");
    profile.points_.push_back({row.values[0], checked_temperature(row.values[1], where)});
  }
  return profile;
}

TemperatureProfile TemperatureProfile::parse(std::string_view text) {
  const auto colon = text.find(':');
  const std::string_view kind = text.substr(0, colon);
  const std::string_view rest = colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
  if (kind == "csv" && !rest.empty()) return from_csv(std::filesystem::path(rest));
  const auto fields = split(rest, ',');
  const auto number = [&](std::size_t i) { return parse_number(fields[i], kWhere, std::string(text)); };
  if (kind == "constant" && fields.size() == 1) return constant(number(0));
  if (kind == "steps" && fields.size() == 4) return steps(number(0), number(1), number(2), number(3));
  if (kind == "sine" && fields.size() == 3) return sine(number(0), number(1), number(2));
  throw InputError(
      kWhere, "temperature", std::string(text),
      "must be constant:C, steps:START_C,RISE_C,INTERVAL_S,COUNT, sine:MEAN_C,AMPLITUDE_C,RAD_S or csv:FILE");
}

double TemperatureProfile::at(double time_s) const noexcept {
  // A period that does not divide the interval exactly must not step one sample late.
  constexpr double kRounding = 1e-9;
  switch (kind_) {
    case Kind::kSteps:
      return base_C_ + change_C_ * std::clamp(std::floor(time_s / rate_ + kRounding), 0.0, count_);
    case Kind::kSine:
      return base_C_ + change_C_ * std::sin(rate_ * time_s);
    case Kind::kPoints:
      return interpolate(time_s);
    case Kind::kConstant:
      break;
  }
  return base_C_;
}

double TemperatureProfile::interpolate(double time_s) const noexcept {
  const auto after = std::upper_bound(points_.begin(), points_.end(), time_s,
                                      [](double time, const Point& point) { return time < point.time_s; });
  if (after == points_.begin()) return points_.front().temperature_C;
  if (after == points_.end()) return points_.back().temperature_C;
  const Point& before = *(after - 1);
  const double fraction = (time_s - before.time_s) / (after->time_s - before.time_s);
  return before.temperature_C + fraction * (after->temperature_C - before.temperature_C);
}

}  // namespace strainwave
