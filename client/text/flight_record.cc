// SPDX-License-Identifier: BSD-3-Clause
#include "client/text/flight_record.h"

#include <fmt/format.h>

#include <array>
#include <fstream>
#include <limits>
#include <sstream>
#include <string_view>

#include "base/gnuplot.h"
#include "base/input_error.h"
#include "lcmtypes/cycle_fields.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

constexpr std::array<std::string_view, 9> kNeeded{"time_s",
                                                  "mode",
                                                  "setpoint_position_rad",
                                                  "setpoint_velocity_rad_s",
                                                  "joint_position_rad",
                                                  "torque_commanded_Nm",
                                                  "torque_applied_Nm",
                                                  "temperature_used_C",
                                                  "temperature_measured_C"};

void read_head_line(const std::string& line, FlightRecordInfo& info) {
  const std::size_t colon = line.find(": ");
  if (colon != std::string::npos) info.head[line.substr(2, colon - 2)] = line.substr(colon + 2);
}

void read_columns(const std::string& line, FlightRecordInfo& info) {
  std::istringstream names(line);
  int number = 0;
  for (std::string name; std::getline(names, name, ',');) info.columns[name] = ++number;
}

constexpr const char* kSettings = R"(set terminal pngcairo size 1100,1400 font 'sans,11' noenhanced
set datafile separator ','
set datafile commentschars '#'
set datafile missing 'nan'
set style line 1 linecolor rgb '#1f5f99' linewidth 1.4
set style line 2 linecolor rgb '#f0a050' linewidth 3.5
set grid
set key autotitle columnhead above right horizontal samplen 2
set lmargin 14
set rmargin 3
set autoscale xfix
set arrow 1 from 0, graph 0 to 0, graph 1 nohead linecolor rgb '#c00000' linewidth 1.4 dashtype 2 front
)";

/// The modes are numbered from 0 without gaps. The first number without a name is their count.
int mode_count() {
  int count = 0;
  while (to_text(static_cast<Mode>(count)) != to_text(static_cast<Mode>(-1))) ++count;
  return count;
}

std::string mode_names() {
  std::string tics;
  for (int mode = 0; mode < mode_count(); ++mode)
    tics += fmt::format("{}'{}' {}", mode == 0 ? "" : ", ", to_text(static_cast<Mode>(mode)), mode);
  return tics;
}

double period_of(const FlightRecordInfo& info, const std::filesystem::path& file) {
  const auto period = info.head.find("period_s");
  if (period == info.head.end()) throw InputError(file.string() + " has no period_s: it is incomplete");
  return parse_number(period->second, file.string(), "period_s");
}

}  // namespace

FlightRecordInfo read_flight_record(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!stream || std::filesystem::is_directory(file))
    throw InputError(file.string() + " cannot be read: check its name, and that you may read it");
  const std::string first_line = fmt::format("# strainwave-flight-record {}", kFlightRecordFormat);
  if (!std::getline(stream, line) || line != first_line)
    throw InputError(fmt::format("{} is not a flight record of format {}: its first line is not '{}'",
                                 file.string(), kFlightRecordFormat, first_line));
  FlightRecordInfo info;
  while (std::getline(stream, line) && line.starts_with("# ")) read_head_line(line, info);
  read_columns(line, info);
  for (const std::string_view name : kNeeded)
    if (!info.columns.contains(std::string(name)))
      throw InputError(file.string() + " has no column " + std::string(name) + ": it is incomplete");
  info.period_s = period_of(info, file);
  return info;
}

double flight_number(const CsvText& csv, std::size_t row, std::size_t column) {
  const std::string& text = csv.rows[row][column];
  if (text == "nan") return std::numeric_limits<double>::quiet_NaN();
  return parse_number(text, csv.place(row), csv.columns[column]);
}

std::string plot_script(const FlightRecordInfo& info, const std::filesystem::path& file,
                        const std::filesystem::path& png, std::optional<double> around_s) {
  const auto column = [&](const char* name) { return info.columns.at(name); };
  const auto head = [&](const char* key) {
    const auto found = info.head.find(key);
    return found == info.head.end() ? std::string("?") : found->second;
  };
  const auto curve = [&](const char* name, const char* title, int style) {
    return fmt::format("FILE using {}:{} with lines linestyle {} title '{}'", column("time_s"), column(name),
                       style, title);
  };
  std::string script =
      fmt::format("set output {}\nFILE = {}\n", gnuplot_quoted(png.string()), gnuplot_quoted(file.string())) +
      kSettings;
  if (around_s) script += fmt::format("set xrange [{}:{}]\n", -*around_s, *around_s);
  script += fmt::format("set multiplot layout 5,1 title {} font 'sans,14'\n",
                        gnuplot_quoted(head("joint") + ": fault " + head("fault") + ", " + head("fault_utc") +
                                       " (cycle " + head("fault_cycle") + ")"));
  script += "set ylabel 'position in rad'\nplot " + curve("setpoint_position_rad", "setpoint", 2) + ", " +
            curve("joint_position_rad", "measured", 1) + "\n";
  script += fmt::format(
      "set ylabel 'error in rad'\nplot FILE using {}:(${} - {} * ${} - ${}) with lines linestyle 1 title "
      "'setpoint - "
      "measured, at one instant'\n",
      column("time_s"), column("setpoint_position_rad"), info.period_s, column("setpoint_velocity_rad_s"),
      column("joint_position_rad"));
  script += "set ylabel 'torque in N.m'\nplot " + curve("torque_commanded_Nm", "commanded", 2) + ", " +
            curve("torque_applied_Nm", "applied", 1) + "\n";
  script += "set ylabel 'temperature in degC'\nplot " + curve("temperature_measured_C", "measured", 2) +
            ", " + curve("temperature_used_C", "used", 1) + "\n";
  script += fmt::format(
      "set ylabel 'mode'\nset ytics ({})\nset yrange [-0.5:{}]\nset xlabel 'time after the fault in s'\n"
      "plot FILE using {}:{} with steps linestyle 1 title 'mode', NaN with lines linecolor rgb '#c00000' "
      "linewidth 1.4 "
      "dashtype 2 title 'fault'\n",
      mode_names(), mode_count() - 0.5, column("time_s"), column("mode"));
  return script + "unset multiplot\n";
}

}  // namespace strainwave
