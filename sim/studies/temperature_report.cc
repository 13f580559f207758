// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/temperature_report.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "base/input_error.h"
#include "control/joint/joint_model.h"
#include "control/scheduled_controller.h"
#include "sim/studies/statistics.h"

namespace strainwave {

namespace {

constexpr const char* kUncompensated = "none";
constexpr const char* kRightSensor = "right";

using Key = std::string TemperatureRow::*;

/// The distinct values of `key`, in order of appearance.
std::vector<std::string> distinct(const std::vector<TemperatureRow>& rows, Key key) {
  std::vector<std::string> values;
  for (const TemperatureRow& row : rows)
    if (std::find(values.begin(), values.end(), row.*key) == values.end()) values.push_back(row.*key);
  return values;
}

const TemperatureRow& row_of(const std::vector<TemperatureRow>& rows, const std::string& way,
                             const std::string& sensor, const std::string& motion, double temperature_C) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const TemperatureRow& row) {
    return row.way == way && row.sensor == sensor && row.motion == motion &&
           row.temperature_C == temperature_C;
  });
  if (found == rows.end())
    throw InputError("temperature: no run of " + way + ", sensor " + sensor + ", " + motion);
  return *found;
}

/// RMS error of one way and sensor over that of another way, per motion.
std::vector<double> ratios(const std::vector<TemperatureRow>& rows, const std::string& way,
                           const std::string& sensor, const std::string& over_way, double temperature_C) {
  std::vector<double> values;
  for (const std::string& motion : distinct(rows, &TemperatureRow::motion))
    values.push_back(row_of(rows, way, sensor, motion, temperature_C).error.rms_rad /
                     row_of(rows, over_way, kRightSensor, motion, temperature_C).error.rms_rad);
  return values;
}

std::string below_percent(double ratio) {
  return number(std::round(1000.0 * (1.0 - ratio)) / 10.0, 3);
}

/// In urad with three significant digits, without an exponent.
std::string microradian(double angle_rad) {
  const double urad = 1e6 * angle_rad;
  const double unit = urad > 0.0 ? std::pow(10.0, std::floor(std::log10(urad)) - 2.0) : 1.0;
  return number(unit * std::round(urad / unit), 9);
}

std::vector<std::string> temperatures_after(const std::string& first) {
  std::vector<std::string> header = {first};
  for (const double temperature_C : kStudyTemperatures_C)
    header.push_back(number(temperature_C, 3) + " degC");
  return header;
}

/// A row per way (or sensor), a column per temperature.
TextTable over_temperature(const std::string& title, const std::string& first,
                           const std::vector<std::string>& names,
                           const std::function<std::string(const std::string&, double)>& value) {
  TextTable table{title, temperatures_after(first), {}};
  for (const std::string& name : names) {
    std::vector<std::string> fields = {name};
    for (const double temperature_C : kStudyTemperatures_C) fields.push_back(value(name, temperature_C));
    table.rows.push_back(fields);
  }
  return table;
}

TextTable cold_table(const std::vector<TemperatureRow>& rows) {
  TextTable table{"RMS and peak error of the link in the cold, -10 degC (urad)", {"way"}, {}};
  const auto motions = distinct(rows, &TemperatureRow::motion);
  table.header.insert(table.header.end(), motions.begin(), motions.end());
  for (const std::string& way : distinct(rows, &TemperatureRow::way)) {
    std::vector<std::string> fields = {way};
    for (const std::string& motion : motions) {
      const PathError& error = row_of(rows, way, kRightSensor, motion, kColdest_C).error;
      fields.push_back(microradian(error.rms_rad) + " / " + microradian(error.peak_rad));
    }
    table.rows.push_back(fields);
  }
  return table;
}

TextTable hundred_table(const std::vector<HundredMoves>& hundred) {
  TextTable table{"A hundred moves of 0.1 rad after a night at -10 degC: RMS and peak error of a move (urad)",
                  {"way", "first", "second", "tenth", "hundredth"},
                  {}};
  for (const HundredMoves& of_way : hundred) {
    std::vector<std::string> fields = {of_way.way};
    for (const std::size_t move : {0U, 1U, 9U, 99U})
      fields.push_back(microradian(of_way.moves[move].rms_rad) + " / " +
                       microradian(of_way.moves[move].peak_rad));
    table.rows.push_back(fields);
  }
  return table;
}

}  // namespace

double rms_over_none(const std::vector<TemperatureRow>& rows, const std::string& way, double temperature_C,
                     const std::string& sensor) {
  return geometric_mean(ratios(rows, way, sensor, kUncompensated, temperature_C));
}

TextTable temperature_rows(const std::vector<TemperatureRow>& rows) {
  TextTable table;
  table.header = {"way",           "sensor",         "motion",      "temperature_C",
                  "rms_error_rad", "peak_error_rad", "switched_off"};
  for (const TemperatureRow& row : rows)
    table.rows.push_back({row.way, row.sensor, row.motion, number(row.temperature_C, 9),
                          number(row.error.rms_rad, 6), number(row.error.peak_rad, 6),
                          row.switched_off ? "yes" : "no"});
  return table;
}

TextTable hundred_moves_rows(const std::vector<HundredMoves>& hundred) {
  TextTable table;
  table.header = {"way", "move", "rms_error_rad", "peak_error_rad"};
  for (const HundredMoves& of_way : hundred)
    for (std::size_t move = 0; move < of_way.moves.size(); ++move)
      table.rows.push_back({of_way.way, std::to_string(move + 1), number(of_way.moves[move].rms_rad, 6),
                            number(of_way.moves[move].peak_rad, 6)});
  return table;
}

std::vector<TextTable> temperature_tables(const std::vector<TemperatureRow>& rows,
                                          const std::vector<HundredMoves>& hundred) {
  const auto ways = distinct(rows, &TemperatureRow::way);
  const auto sensors = distinct(rows, &TemperatureRow::sensor);
  const std::string& product = ways.back();
  const auto mean = [&](const std::string& way, double temperature_C) {
    return below_percent(rms_over_none(rows, way, temperature_C));
  };
  const auto least = [&](const std::string& way, double temperature_C) {
    const auto all = ratios(rows, way, kRightSensor, kUncompensated, temperature_C);
    return below_percent(*std::max_element(all.begin(), all.end()));
  };
  const auto of_sensor = [&](const std::string& sensor, double temperature_C) {
    return below_percent(rms_over_none(rows, product, temperature_C, sensor));
  };
  return {
      over_temperature("RMS error below uncompensated (%), geometric mean of the motions", "way", ways, mean),
      over_temperature("RMS error below uncompensated (%), the worst motion", "way", ways, least),
      cold_table(rows),
      over_temperature("RMS error below uncompensated (%), '" + product + "' with a sensor that is wrong",
                       "sensor", sensors, of_sensor),
      hundred_table(hundred)};
}

TextTable learned_table(const std::vector<TemperatureRow>& rows) {
  const std::string product = distinct(rows, &TemperatureRow::way).back();
  return over_temperature(
      "RMS error of '" + product + "' below uncompensated (%), the sixth of the same motions", "sensor",
      distinct(rows, &TemperatureRow::sensor), [&](const std::string& sensor, double temperature_C) {
        return below_percent(rms_over_none(rows, product, temperature_C, sensor));
      });
}

TextTable friction_known_table(const std::vector<TemperatureRow>& rows) {
  const std::string product = distinct(rows, &TemperatureRow::way).back();
  return over_temperature(
      "RMS error of '" + product + "' below uncompensated (%) where the table has the joint's very friction",
      "of the motions", {"mean", "worst"}, [&](const std::string& which, double temperature_C) {
        const auto all = ratios(rows, product, kRightSensor, kUncompensated, temperature_C);
        return below_percent(which == "mean" ? geometric_mean(all)
                                             : *std::max_element(all.begin(), all.end()));
      });
}

TextTable friction_table(const GainTable& gains, const JointPlantConfig& plant) {
  TextTable table{"What limits: friction that the table does not know, over the position gain", {"degC"}, {}};
  constexpr std::array<double, 3> kSpeeds_rad_s = {0.01, 0.1, 1.0};
  for (const double speed_rad_s : kSpeeds_rad_s) {
    const std::string at = " at " + number(speed_rad_s, 3) + " rad/s";
    for (const char* what : {"true (N.m)", "table (N.m)", "error (urad)"}) table.header.push_back(what + at);
  }
  JointModel model;
  model.stribeck = gains.friction.velocity.stribeck();
  for (const double temperature_C : kStudyTemperatures_C) {
    model.friction = gains.friction.blend(gains.friction.weights(temperature_C));
    std::vector<std::string> fields = {number(temperature_C, 3)};
    for (const double speed_rad_s : kSpeeds_rad_s) {
      const double true_Nm =
          stribeck_friction_Nm(plant.joint.friction.at(temperature_C), plant.joint.stribeck, speed_rad_s);
      const double known_Nm = model.friction_Nm(speed_rad_s);
      fields.push_back(number(true_Nm, 3));
      fields.push_back(number(known_Nm, 3));
      fields.push_back(microradian(std::abs((true_Nm - known_Nm) / gains.primary.gain(0)(1))));
    }
    table.rows.push_back(fields);
  }
  return table;
}

std::vector<Figure> temperature_figures(const std::vector<TemperatureRow>& rows,
                                        const std::vector<HundredMoves>& hundred) {
  Figure over{"temperature", "RMS error of the link over temperature, the sensor right.", 3, {}};
  const auto ways = distinct(rows, &TemperatureRow::way);
  for (const std::string& motion : distinct(rows, &TemperatureRow::motion)) {
    Panel panel{motion, "temperature (°C)", "RMS error (rad)", "", {}, true, {}, {}, over.panels.empty()};
    for (std::size_t w = 0; w < ways.size(); ++w) {
      Points points;
      for (const double temperature_C : kStudyTemperatures_C)
        points.emplace_back(temperature_C,
                            row_of(rows, ways[w], kRightSensor, motion, temperature_C).error.rms_rad);
      panel.series.push_back({ways[w], points, Mark::kLine, static_cast<int>(w), false});
    }
    over.panels.push_back(panel);
  }
  Panel moves{"a hundred moves of 0.1 rad, -10 °C", "move", "RMS error (rad)", "", {}, true, {}, {}, true};
  for (std::size_t w = 0; w < hundred.size(); ++w) {
    Points points;
    for (std::size_t move = 0; move < hundred[w].moves.size(); ++move)
      points.emplace_back(static_cast<double>(move + 1), hundred[w].moves[move].rms_rad);
    moves.series.push_back({hundred[w].way, points, Mark::kLine, static_cast<int>(w), false});
  }
  return {over, {"hundred_moves", "What learns, and what does not need to.", 1, {moves}}};
}

}  // namespace strainwave
