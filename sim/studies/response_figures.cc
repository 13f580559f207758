// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "sim/studies/chapter6_figures.h"
#include "sim/studies/text_table.h"

namespace strainwave {

namespace {

constexpr int kSetpointColour = 7;
constexpr int kLimitColour = 0;

/// The smallest value that is drawn, since a logarithmic axis has no 0.
constexpr double kSmallestDrawn_rad = 1e-9;

/// Returns the same colour for a contender in every figure.
int colour_of(const Chapter6& chapter, const std::string& contender) {
  const auto found = std::find(chapter.contenders.begin(), chapter.contenders.end(), contender);
  return 1 + static_cast<int>(found - chapter.contenders.begin());
}

template <typename Value>
Points over_time(const std::vector<TracePoint>& trace, double from_s, double to_s, const Value& value) {
  Points points;
  for (const TracePoint& point : trace)
    if (point.time_s >= from_s && point.time_s <= to_s) points.emplace_back(point.time_s, value(point));
  return points;
}

double position(const TracePoint& point) {
  return point.joint_position_rad;
}
double setpoint(const TracePoint& point) {
  return point.setpoint_position_rad;
}
double error(const TracePoint& point) {
  return point.setpoint_position_rad - point.joint_position_rad;
}
double error_urad(const TracePoint& point) {
  return 1e6 * error(point);
}

std::string range_text(int range) {
  return number(kRangeStart_rad[static_cast<std::size_t>(range)]) + " rad";
}

Series contender_series(const Chapter6& chapter, const Chapter6Key& key, const std::string& contender,
                        double from_s, double to_s, double (*value)(const TracePoint&)) {
  // C3's gains are nearly C1's, so that one curve would hide the other.
  const Mark mark = contender == "C3" ? Mark::kDashed : Mark::kLine;
  return {contender, over_time(chapter.at(key, contender).trace, from_s, to_s, value), mark,
          colour_of(chapter, contender), false};
}

/// One panel per contender: position against the staircase.
Figure step_responses(const Chapter6& chapter, Setting setting, int range) {
  const Chapter6Key key{setting, Scenario::kStaircase, range};
  Figure figure{"steps_" + std::string(name(setting)) + "_" + std::to_string(range + 1),
                "Step responses from " + range_text(range) + ", " + std::string(name(setting)) +
                    " setting, temperature 15 + 25 sin(t) °C.",
                3,
                {}};
  for (const std::string& contender : chapter.contenders) {
    const auto& trace = chapter.at(key, contender).trace;
    figure.panels.push_back(
        {contender,
         "time (s)",
         "position (rad)",
         "",
         {{"setpoint", over_time(trace, 0, 5, setpoint), Mark::kStaircase, kSetpointColour, false},
          contender_series(chapter, key, contender, 0, 5, position)},
         false,
         {0, 5},
         {0, 11.0 * kRangeStart_rad[static_cast<std::size_t>(range)]},
         false});
  }
  return figure;
}

/// Decades around all drawn values, with room below, since a point on the axis is invisible.
std::vector<double> decades(const std::vector<Series>& drawn) {
  double low = 1.0;
  double high = kSmallestDrawn_rad;
  for (const Series& series : drawn) {
    for (const auto& [time_s, value] : series.points) {
      low = std::min(low, value);
      high = std::max(high, value);
    }
  }
  return {std::pow(10.0, std::floor(std::log10(low) - 0.3)), std::pow(10.0, std::ceil(std::log10(high)))};
}

/// Error on a logarithmic scale, all contenders, one panel per range.
Figure error_magnitudes(const Chapter6& chapter, Setting setting, Scenario scenario) {
  Figure figure{"errors_" + std::string(name(scenario)) + "_" + std::string(name(setting)),
                "Size of the error, " + std::string(name(scenario)) + ", " + std::string(name(setting)) +
                    " setting; below 1 nrad it is drawn as 1 nrad.",
                2,
                {}};
  for (int range = 0; range < kRangeCount; ++range) {
    Panel panel{"from " + range_text(range), "time (s)", "|error| (rad)", "", {}, true, {}, {}, true};
    for (const std::string& contender : chapter.contenders) {
      Series series = contender_series(chapter, {setting, scenario, range}, contender, 0, 12, error);
      for (auto& [time_s, value] : series.points) value = std::max(std::abs(value), kSmallestDrawn_rad);
      panel.series.push_back(series);
    }
    panel.y_range = decades(panel.series);
    figure.panels.push_back(panel);
  }
  return figure;
}

/// The scale shows the largest error of the scheduled controllers; other curves may leave the figure.
double largest_error_urad(const Chapter6& chapter, const Chapter6Key& key, double from_s, double to_s) {
  double largest_urad = 20.0;
  for (const char* contender : {"C4", "C4+"})
    for (const auto& [time_s, urad] :
         contender_series(chapter, key, contender, from_s, to_s, error_urad).points)
      largest_urad = std::max(largest_urad, 1.2 * std::abs(urad));
  return largest_urad;
}

/// The error in urad around two steps of the temperature, which is on the right axis.
Figure temperature_steps(const Chapter6& chapter, Setting setting, double from_s, double to_s,
                         const std::string& id, const std::string& caption) {
  Figure figure{
      id + "_" + std::string(name(setting)), caption + " " + std::string(name(setting)) + " setting.", 2, {}};
  for (int range = 0; range < kRangeCount; ++range) {
    const Chapter6Key key{setting, Scenario::kRamp, range};
    Panel panel{"setpoint " + range_text(range),
                "time (s)",
                "error (µrad)",
                "temperature (°C)",
                {},
                false,
                {from_s, to_s},
                {},
                true};
    const double largest_urad = largest_error_urad(chapter, key, from_s, to_s);
    panel.y_range = {-largest_urad, largest_urad};
    for (const char* contender : {"C3", "C4", "PID", "C4+"})
      panel.series.push_back(contender_series(chapter, key, contender, from_s, to_s, error_urad));
    panel.series.push_back({"temperature",
                            over_time(chapter.at(key, "C4").trace, from_s, to_s,
                                      [](const TracePoint& point) { return point.joint_temperature_C; }),
                            Mark::kStaircase, kSetpointColour, true});
    figure.panels.push_back(panel);
  }
  return figure;
}

/// The first move beside the fastest one that physics allow.
Figure against_the_limit(const Chapter6& chapter, Setting setting) {
  constexpr std::array kWindow_s = {0.05, 0.1, 0.2, 0.5};
  Figure figure{"limit_" + std::string(name(setting)),
                "The first move of the ramp scenario beside the time-optimal one, " +
                    std::string(name(setting)) + " setting.",
                2,
                {}};
  for (int range = 0; range < kRangeCount; ++range) {
    const Chapter6Key key{setting, Scenario::kRamp, range};
    const double to_s = kWindow_s[static_cast<std::size_t>(range)];
    Panel panel{
        "setpoint " + range_text(range), "time (s)", "position (rad)", "", {}, false, {0, to_s}, {}, true};
    for (const std::string& contender : chapter.contenders)
      panel.series.push_back(contender_series(chapter, key, contender, 0, to_s, position));
    panel.series.push_back({"time-optimal", over_time(chapter.limit(key)->trace, 0, to_s, position),
                            Mark::kDashed, kLimitColour, false});
    figure.panels.push_back(panel);
  }
  return figure;
}

Figure resting_torque(const Chapter6& chapter) {
  Figure figure{
      "resting_torque",
      "Torque wanted while the joint stands at its setpoint (ramp, last second), realistic setting.",
      2,
      {}};
  for (int range = 0; range < kRangeCount; ++range) {
    Panel panel{
        "setpoint " + range_text(range), "time (s)", "torque (N·m)", "", {}, false, {11, 12}, {}, true};
    for (const char* contender : {"C3", "C4", "PID", "C4+"})
      panel.series.push_back(
          contender_series(chapter, {Setting::kRealistic, Scenario::kRamp, range}, contender, 11, 12,
                           [](const TracePoint& point) { return point.wanted_torque_Nm; }));
    figure.panels.push_back(panel);
  }
  return figure;
}

}  // namespace

std::vector<Figure> response_figures(const Chapter6& chapter) {
  std::vector<Figure> figures;
  figures.reserve(static_cast<std::size_t>(kRangeCount));
  for (int range = 0; range < kRangeCount; ++range)
    figures.push_back(step_responses(chapter, Setting::kIdeal, range));
  figures.push_back(step_responses(chapter, Setting::kRealistic, 0));
  for (const Scenario scenario : kScenarios)
    for (const Setting setting : {Setting::kIdeal, Setting::kRealistic})
      figures.push_back(error_magnitudes(chapter, setting, scenario));
  for (const Setting setting : {Setting::kIdeal, Setting::kRealistic}) {
    figures.push_back(
        temperature_steps(chapter, setting, 0.5, 12.0, "temperature_ramp",
                          "Error while the temperature rises from -10 to 45 °C, after the first move;"));
    figures.push_back(temperature_steps(chapter, setting, 2.9, 4.2, "temperature_zoom",
                                        "The same around two steps of the temperature, enlarged;"));
  }
  figures.push_back(against_the_limit(chapter, Setting::kLimited));
  figures.push_back(against_the_limit(chapter, Setting::kRealistic));
  figures.push_back(resting_torque(chapter));
  return figures;
}

}  // namespace strainwave
