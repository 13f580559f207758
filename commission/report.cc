// SPDX-License-Identifier: BSD-3-Clause
#include "commission/report.h"

#include <fmt/format.h>

#include <cmath>
#include <complex>

#include "base/printable.h"
#include "base/units.h"
#include "commission/report_chart.h"

namespace strainwave {

namespace {

constexpr double kDegrees = 360.0 / kTurn_rad;
constexpr int kModelPoints = 200;
constexpr int kDigits = 4;

constexpr const char* kStyle = R"(
:root { color-scheme: light dark; --ink: #1b1f24; --paper: #ffffff; --grid: #d9dde2; --one: #0b62a8; --two: #c2410c; }
@media (prefers-color-scheme: dark) { :root { --ink: #e4e7eb; --paper: #15181c; --grid: #363c44; --one: #63b3ed; --two: #f6a35c; } }
body { font: 15px/1.5 sans-serif; color: var(--ink); background: var(--paper); max-width: 760px; margin: 2em auto; padding: 0 1em; }
table { border-collapse: collapse; } td, th { padding: .2em .8em .2em 0; text-align: left; border-bottom: 1px solid var(--grid); }
td.number { text-align: right; font-variant-numeric: tabular-nums; }
pre { white-space: pre-wrap; } svg { width: 100%; height: auto; } svg text { fill: var(--ink); font-size: 12px; }
.grid { stroke: var(--grid); fill: none; } .problem { color: var(--two); font-weight: bold; }
.curve0 path { stroke: var(--one); fill: none; stroke-width: 1.5; } .curve0 circle { fill: var(--one); }
.curve1 path { stroke: var(--two); fill: none; stroke-width: 1.5; } .curve1 circle { fill: var(--two); }
)";

std::string cell(const std::string& text) {
  return "<td>" + html_text(text) + "</td>";
}

std::string number_cell(const std::string& text) {
  return "<td class=\"number\">" + html_text(text) + "</td>";
}

/// `value` with `count` significant digits, with an exponent only if that is shorter.
std::string digits(double value, int count) {
  return number_text(rounded(value, count));
}

std::string heading(const std::string& text) {
  return "<h2>" + html_text(text) + "</h2>\n";
}

std::string beginning(const CommissionRecord& record) {
  std::string html =
      fmt::format("<h1>Commissioning of {}</h1>\n<p>{}, configuration {}; {:.0f} s of the joint's time",
                  html_text(record.joint), record.simulated ? "Simulated joint" : "Real joint",
                  html_text(record.configuration), record.joint_time_s);
  if (record.temperature_C) html += fmt::format(", at {:.1f} °C", *record.temperature_C);
  html += ".</p>\n";
  if (!record.problem.empty())
    html += "<p class=\"problem\">Ended early: " + html_text(record.problem) + "</p>\n";
  return html;
}

const char* text_of(StepOutcome outcome) {
  switch (outcome) {
    case StepOutcome::kDone:
      return "done";
    case StepOutcome::kFailed:
      return "ended early";
    case StepOutcome::kSkipped:
      return "skipped";
  }
  return "";
}

std::string steps_table(const CommissionRecord& record) {
  std::string html =
      heading("Steps") + "<table><tr><th>step</th><th>outcome</th><th>found</th><th>s</th></tr>\n";
  for (const CommissionStep& step : record.steps)
    html += "<tr>" + cell(step.name) + cell(text_of(step.outcome)) + cell(step.text) +
            number_cell(fmt::format("{:.1f}", step.time_s)) + "</tr>\n";
  return html + "</table>\n";
}

void add_row(std::string& html, const std::string& name, const std::string& configured,
             const IntervalEstimate& measured, const std::string& used, const std::string& unit) {
  html += "<tr>" + cell(name) + number_cell(configured) + number_cell(digits(measured.value, kDigits)) +
          number_cell(measured.half_width_95 > 0.0 ? "±" + digits(measured.half_width_95, 2) : "") +
          number_cell(used) + cell(unit) + "</tr>\n";
}

std::string values_table(const CommissionRecord& record) {
  std::string html =
      heading("Configured, measured, used") +
      "<table><tr><th>quantity</th><th>configured</th><th>measured</th><th>95 %</th><th>used</th>"
      "<th>unit</th></tr>\n";
  for (const CommissionValue& value : record.values)
    add_row(html, value.key, value.configured ? digits(*value.configured, kDigits) : "", value.measured,
            digits(value.used, kDigits), value.unit);
  if (record.breakaway_positive_Nm)
    add_row(html, "breakaway torque, positive", "", *record.breakaway_positive_Nm, "", "N m");
  if (record.breakaway_negative_Nm)
    add_row(html, "breakaway torque, negative", "", *record.breakaway_negative_Nm, "", "N m");
  if (record.kinematic_error_rad) {
    add_row(html, "kinematic error, once per motor turn", "", {(*record.kinematic_error_rad)[0], 0.0}, "",
            "rad");
    add_row(html, "kinematic error, twice per motor turn", "", {(*record.kinematic_error_rad)[1], 0.0}, "",
            "rad");
  }
  return html + "</table>\n";
}

/// The angle, shifted by whole turns to within half a turn of `near_rad`.
double nearest_turn_rad(double angle_rad, double near_rad) {
  return angle_rad - kTurn_rad * std::round((angle_rad - near_rad) / kTurn_rad);
}

std::string response_charts(const CommissionRecord& record) {
  if (record.response.empty()) return "";
  Chart magnitude{"Magnitude of the response",
                  "frequency, Hz",
                  "motor velocity over torque, rad/s per N.m",
                  true,
                  true,
                  {{"measured", {}, false}, {"model", {}, true}}};
  Chart phase{"Phase of the response",
              "frequency, Hz",
              "phase, degrees",
              true,
              false,
              {{"measured", {}, false}, {"model", {}, true}}};
  for (const ResponsePoint& point : record.response) {
    double phase_rad = point.phase_rad;
    if (record.model)
      phase_rad = nearest_turn_rad(phase_rad, response_of(*record.model, point.frequency_Hz).phase_rad);
    magnitude.curves[0].points.push_back({point.frequency_Hz, point.magnitude_rad_sNm});
    phase.curves[0].points.push_back({point.frequency_Hz, phase_rad * kDegrees});
  }
  if (record.model) {
    const double first = record.response.front().frequency_Hz, last = record.response.back().frequency_Hz;
    for (int i = 0; i <= kModelPoints; ++i) {
      const ResponsePoint point =
          response_of(*record.model, first * std::pow(last / first, static_cast<double>(i) / kModelPoints));
      magnitude.curves[1].points.push_back({point.frequency_Hz, point.magnitude_rad_sNm});
      phase.curves[1].points.push_back({point.frequency_Hz, point.phase_rad * kDegrees});
    }
  }
  return heading("Response of the motor to torque") + to_svg(magnitude) + to_svg(phase) +
         "<p>The model has the stiffness of slow motion. A swing within the lost motion meets up to twice "
         "this stiffness, so the measured resonance may be up to 1.4 times higher.</p>\n";
}

std::string friction_chart(const CommissionRecord& record, const ReportedDesign& design) {
  if (record.friction.empty()) return "";
  Chart chart{"Friction",      "speed of the joint, rad/s",
              "friction, N.m", false,
              false,           {{"measured", {}, false}, {"the table's", {}, true}}};
  for (const FrictionAtSpeed& at : record.friction)
    chart.curves[0].points.push_back({at.speed_rad_s, at.torque_Nm.value, at.torque_Nm.half_width_95});
  for (const FrictionAtSpeed& at : design.friction)
    chart.curves[1].points.push_back({at.speed_rad_s, at.torque_Nm.value});
  return heading("Friction over speed") + to_svg(chart);
}

std::string preformatted(const std::string& title, const std::string& text) {
  return text.empty() ? "" : heading(title) + "<pre>" + html_text(text) + "</pre>\n";
}

}  // namespace

ResponsePoint response_of(const ResponseModel& model, double frequency_Hz) {
  const std::complex<double> s(0.0, kTurn_rad * frequency_Hz);
  const double motor = model.motor_inertia_kgm2, link = model.link_inertia_kgm2;
  const std::complex<double> spring = model.damping_Nms_rad * s + model.stiffness_Nm_rad;
  const std::complex<double> response =
      (link * s * s + spring) / (s * (motor * link * s * s + (motor + link) * spring));
  return {frequency_Hz, std::abs(response), std::arg(response) - kTurn_rad * frequency_Hz * model.delay_s};
}

std::string to_html(const CommissionRecord& record, const ReportedDesign& design) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width\">\n<title>Commissioning of " +
         html_text(record.joint) + "</title>\n<style>" + kStyle + "</style></head>\n<body>\n" +
         beginning(record) + values_table(record) + response_charts(record) + friction_chart(record, design) +
         steps_table(record) + preformatted("Certificate", design.certificate) +
         preformatted("First motion", design.next) + "</body></html>\n";
}

}  // namespace strainwave
