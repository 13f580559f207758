// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/time_profile.h"

#include <algorithm>
#include <cmath>

#include "base/csv.h"
#include "base/input_error.h"
#include "base/printable.h"

namespace strainwave {

namespace {

double checked(double value, const ProfileQuantity& quantity, const std::string& where) {
  if (!(value >= quantity.min && value <= quantity.max))
    throw InputError(where, quantity.key, number_text(value),
                     "must be in [" + number_text(quantity.min) + ", " + number_text(quantity.max) + "]");
  return value;
}

void require(bool valid, const ProfileQuantity& quantity, const char* key, double value,
             const char* allowed) {
  if (!valid) throw InputError("profile of " + quantity.key, key, number_text(value), allowed);
}

std::string place(const ProfileQuantity& quantity) {
  return "profile of " + quantity.key;
}

}  // namespace

TimeProfile TimeProfile::constant(double value, const ProfileQuantity& quantity) {
  TimeProfile profile;
  profile.base_ = checked(value, quantity, place(quantity));
  return profile;
}

TimeProfile TimeProfile::steps(double start, double rise, double interval_s, double count,
                               const ProfileQuantity& quantity) {
  require(std::isfinite(interval_s) && interval_s > 0.0, quantity, "interval_s", interval_s,
          "must be finite and > 0");
  require(std::isfinite(count) && count >= 1.0 && count == std::floor(count), quantity, "count", count,
          "must be a whole number >= 1");
  TimeProfile profile;
  profile.kind_ = Kind::kSteps;
  profile.base_ = checked(start, quantity, place(quantity));
  profile.change_ = rise;
  profile.rate_ = interval_s;
  profile.count_ = count;
  checked(start + rise * count, quantity, place(quantity));
  return profile;
}

TimeProfile TimeProfile::ramp(double first, double second, double begin_s, double end_s,
                              const ProfileQuantity& quantity) {
  require(std::isfinite(begin_s), quantity, "begin_s", begin_s, "must be finite");
  require(std::isfinite(end_s) && end_s > begin_s, quantity, "end_s", end_s,
          "must be finite and greater than begin_s");
  TimeProfile profile;
  profile.kind_ = Kind::kLines;
  profile.points_ = {{begin_s, checked(first, quantity, place(quantity))},
                     {end_s, checked(second, quantity, place(quantity))}};
  return profile;
}

TimeProfile TimeProfile::square(double first, double second, double interval_s,
                                const ProfileQuantity& quantity) {
  require(std::isfinite(interval_s) && interval_s > 0.0, quantity, "interval_s", interval_s,
          "must be finite and > 0");
  TimeProfile profile;
  profile.kind_ = Kind::kSquare;
  profile.base_ = checked(first, quantity, place(quantity));
  profile.change_ = checked(second, quantity, place(quantity)) - first;
  profile.rate_ = interval_s;
  return profile;
}

TimeProfile TimeProfile::sine(double mean, double amplitude, double angular_frequency_rad_s,
                              const ProfileQuantity& quantity) {
  require(std::isfinite(angular_frequency_rad_s), quantity, "angular_frequency_rad_s",
          angular_frequency_rad_s, "must be finite");
  TimeProfile profile;
  profile.kind_ = Kind::kSine;
  profile.base_ = mean;
  profile.change_ = amplitude;
  profile.rate_ = angular_frequency_rad_s;
  checked(mean - std::abs(amplitude), quantity, place(quantity));
  checked(mean + std::abs(amplitude), quantity, place(quantity));
  return profile;
}

TimeProfile TimeProfile::from_csv(const std::filesystem::path& path, bool hold,
                                  const ProfileQuantity& quantity) {
  TimeProfile profile;
  profile.kind_ = hold ? Kind::kHold : Kind::kLines;
  const CsvTable table = read_csv(path);
  table.require_columns({"time_s", quantity.key});
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double time_s = table.rows[i][0];
    if (!profile.points_.empty() && time_s <= profile.points_.back().time_s)
      throw InputError(table.place(i), "time_s", number_text(time_s),
                       "must be greater than in the row before");
    profile.points_.push_back({time_s, checked(table.rows[i][1], quantity, table.place(i))});
  }
  return profile;
}

TimeProfile TimeProfile::parse(std::string_view text, const ProfileQuantity& quantity,
                               const std::filesystem::path& folder) {
  const auto colon = text.find(':');
  const std::string_view kind = text.substr(0, colon);
  const std::string_view rest = colon == std::string_view::npos ? std::string_view{} : text.substr(colon + 1);
  if ((kind == "csv" || kind == "hold") && !rest.empty())
    return from_csv(folder / rest, kind == "hold", quantity);
  const auto fields = split(rest, ',');
  const auto number = [&](std::size_t i) {
    return parse_number(fields[i], place(quantity), std::string(text));
  };
  if (kind == "constant" && fields.size() == 1) return constant(number(0), quantity);
  if (kind == "steps" && fields.size() == 4)
    return steps(number(0), number(1), number(2), number(3), quantity);
  if (kind == "ramp" && fields.size() == 4) return ramp(number(0), number(1), number(2), number(3), quantity);
  if (kind == "square" && fields.size() == 3) return square(number(0), number(1), number(2), quantity);
  if (kind == "sine" && fields.size() == 3) return sine(number(0), number(1), number(2), quantity);
  throw InputError(
      place(quantity), "text", "'" + std::string(text) + "'",
      "must be constant:VALUE, steps:START,RISE,INTERVAL_S,COUNT, ramp:FIRST,SECOND,BEGIN_S,END_S, "
      "square:FIRST,SECOND,INTERVAL_S, sine:MEAN,AMPLITUDE,RAD_S, csv:FILE or "
      "hold:FILE");
}

double TimeProfile::at(double time_s) const noexcept {
  // Without this tolerance, a period that does not divide the interval exactly could step one sample late.
  constexpr double kRounding = 1e-9;
  switch (kind_) {
    case Kind::kSteps:
      return base_ + change_ * std::clamp(std::floor(time_s / rate_ + kRounding), 0.0, count_);
    case Kind::kSquare:
      return base_ + change_ * std::fmod(std::floor(std::max(0.0, time_s) / rate_ + kRounding), 2.0);
    case Kind::kSine:
      return base_ + change_ * std::sin(rate_ * time_s);
    case Kind::kLines:
    case Kind::kHold:
      return interpolate(time_s);
    case Kind::kConstant:
      break;
  }
  return base_;
}

double TimeProfile::interpolate(double time_s) const noexcept {
  const auto after = std::upper_bound(points_.begin(), points_.end(), time_s,
                                      [](double time, const Point& point) { return time < point.time_s; });
  if (after == points_.begin()) return points_.front().value;
  const Point& before = *(after - 1);
  if (after == points_.end() || kind_ == Kind::kHold) return before.value;
  const double fraction = (time_s - before.time_s) / (after->time_s - before.time_s);
  return before.value + fraction * (after->value - before.value);
}

}  // namespace strainwave
