// SPDX-License-Identifier: BSD-3-Clause
#include "commission/report_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/printable.h"

namespace strainwave {

namespace {

// Dimensions of the picture in its own units.
constexpr double kWidth = 640.0;
constexpr double kHeight = 300.0;
constexpr double kLeft = 70.0;
constexpr double kRight = 20.0;
constexpr double kTop = 26.0;
constexpr double kBottom = 46.0;
constexpr double kTicks = 5.0;    // about this number on an axis
constexpr double kRoom = 0.05;    // margin above and below the curves, share of the range
constexpr double kBarHalf = 3.0;  // half length of an interval's end
constexpr double kLegendStep = 130.0;

/// Maps the values of one axis to places in the picture.
struct Axis {
  bool logarithmic = false;
  double low = std::numeric_limits<double>::infinity();  ///< of the values, or of their decimal logarithms
  double high = -std::numeric_limits<double>::infinity();
  double begin = 0.0;  ///< places of low and high
  double end = 0.0;

  double scaled(double value) const { return logarithmic ? std::log10(value) : value; }
  bool shows(double value) const { return std::isfinite(value) && !(logarithmic && value <= 0.0); }
  void include(double value) {
    if (!shows(value)) return;
    low = std::min(low, scaled(value));
    high = std::max(high, scaled(value));
  }
  void widen() {
    const double range = high > low ? high - low : std::max(1.0, std::abs(high));
    low -= kRoom * range;
    high += kRoom * range;
  }
  double place(double value) const { return begin + (scaled(value) - low) / (high - low) * (end - begin); }
};

/// Multiples of one step, which is 1, 2 or 5 times a power of ten. On a logarithmic axis, all such numbers within the range.
std::vector<double> ticks(const Axis& axis) {
  std::vector<double> values;
  if (axis.logarithmic) {
    for (double decade = std::floor(axis.low); decade <= axis.high; ++decade)
      for (const double digit : {1.0, 2.0, 5.0})
        if (const double value = digit * std::pow(10.0, decade);
            axis.scaled(value) >= axis.low && axis.scaled(value) <= axis.high)
          values.push_back(value);
    return values;
  }
  const double wanted = (axis.high - axis.low) / kTicks;
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  // The nearest such step by ratio.
  const double digit = wanted / decade;
  const double step = decade * (digit > 7.1 ? 10.0 : digit > 3.2 ? 5.0 : digit > 1.4 ? 2.0 : 1.0);
  for (double at = std::ceil(axis.low / step); at * step <= axis.high; ++at) values.push_back(at * step);
  return values;
}

std::string axes(const Chart& chart, const Axis& x, const Axis& y) {
  std::string svg;
  for (const double value : ticks(x))
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{0:.1f} {1:.1f}V{2:.1f}\"/><text x=\"{0:.1f}\" y=\"{3:.1f}\" "
        "text-anchor=\"middle\">{4:g}</text>\n",
        x.place(value), y.end, y.begin, y.begin + 16.0, value);
  for (const double value : ticks(y))
    svg += fmt::format(
        "<path class=\"grid\" d=\"M{1:.1f} {0:.1f}H{2:.1f}\"/><text x=\"{3:.1f}\" y=\"{4:.1f}\" "
        "text-anchor=\"end\">{5:g}</text>\n",
        y.place(value), x.begin, x.end, x.begin - 6.0, y.place(value) + 4.0, value);
  svg += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n",
                     0.5 * (x.begin + x.end), kHeight - 8.0, html_text(chart.x_label));
  svg +=
      fmt::format("<text transform=\"translate(14 {:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                  0.5 * (y.begin + y.end), html_text(chart.y_label));
  return svg;
}

std::string curve_svg(const ChartCurve& curve, std::size_t number, const Axis& x, const Axis& y) {
  std::string path, marks;
  for (const ChartPoint& point : curve.points) {
    if (!x.shows(point.x) || !y.shows(point.y)) continue;
    const double at_x = x.place(point.x), at_y = y.place(point.y);
    if (curve.line) {
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? 'M' : 'L', at_x, at_y);
      continue;
    }
    marks += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/>", at_x, at_y);
    if (point.half_width > 0.0 && y.shows(point.y - point.half_width))
      path += fmt::format("M{0:.1f} {2:.1f}H{1:.1f}M{0:.1f} {3:.1f}H{1:.1f}M{4:.1f} {2:.1f}V{3:.1f}",
                          at_x - kBarHalf, at_x + kBarHalf, y.place(point.y - point.half_width),
                          y.place(point.y + point.half_width), at_x);
  }
  std::string svg = fmt::format("<g class=\"curve{}\">", number);
  if (!path.empty()) svg += "<path d=\"" + path + "\"/>";
  return svg + marks + "</g>\n";
}

/// Labels of the curves, above the frame.
std::string legend(const Chart& chart) {
  std::string svg;
  double at = kLeft;
  for (std::size_t i = 0; i < chart.curves.size(); ++i) {
    const ChartCurve& curve = chart.curves[i];
    if (curve.label.empty() || curve.points.empty()) continue;
    svg += fmt::format("<g class=\"curve{}\">", i);
    svg += curve.line ? fmt::format("<path d=\"M{:.1f} 10h16\"/>", at)
                      : fmt::format("<circle cx=\"{:.1f}\" cy=\"10\" r=\"3\"/>", at + 8.0);
    svg += fmt::format("</g><text x=\"{:.1f}\" y=\"14\">{}</text>\n", at + 22.0, html_text(curve.label));
    at += kLegendStep;
  }
  return svg;
}

}  // namespace

std::string html_text(const std::string& text) {
  std::string escaped;
  for (const char c : printable_lines(text)) {
    switch (c) {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

std::string to_svg(const Chart& chart) {
  Axis x{chart.x_logarithmic};
  Axis y{chart.y_logarithmic};
  for (const ChartCurve& curve : chart.curves)
    for (const ChartPoint& point : curve.points) {
      if (!x.shows(point.x) || !y.shows(point.y)) continue;
      x.include(point.x);
      y.include(point.y - point.half_width);
      y.include(point.y + point.half_width);
    }
  if (!(x.low <= x.high && y.low <= y.high)) return "";
  x.widen();
  y.widen();
  x.begin = kLeft;
  x.end = kWidth - kRight;
  y.begin = kHeight - kBottom;
  y.end = kTop;
  std::string svg = fmt::format("<svg viewBox=\"0 0 {:g} {:g}\" role=\"img\"><title>{}</title>\n", kWidth,
                                kHeight, html_text(chart.title));
  svg += axes(chart, x, y);
  for (std::size_t i = 0; i < chart.curves.size(); ++i) svg += curve_svg(chart.curves[i], i, x, y);
  return svg + legend(chart) + "</svg>\n";
}

}  // namespace strainwave
