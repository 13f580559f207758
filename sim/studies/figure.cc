// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/figure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/gnuplot.h"
#include "base/parallel.h"
#include "base/text_file.h"

namespace strainwave {

namespace {

constexpr int kPanelWidth = 460;
constexpr int kPanelHeight = 330;
// Okabe and Ito's palette: distinct for colour-blind readers.
constexpr std::array<const char*, 8> kPalette = {"#000000", "#E69F00", "#56B4E9", "#009E73",
                                                 "#0072B2", "#D55E00", "#CC79A7", "#999999"};

std::string block_name(std::size_t figure, std::size_t panel, std::size_t series) {
  return "$d" + std::to_string(figure) + "_" + std::to_string(panel) + "_" + std::to_string(series);
}

void write_data(std::string& script, const std::string& name, const Points& points) {
  script += name + " << EOD\n";
  std::array<char, 64> line;
  for (const auto& [x, y] : points) {
    const int length = std::snprintf(line.data(), line.size(), "%.7g %.7g\n", x, y);
    script.append(line.data(), static_cast<std::size_t>(length));
  }
  script += "EOD\n";
}

std::string range(const char* axis, const std::vector<double>& limits) {
  if (limits.size() != 2) return std::string("set autoscale ") + axis + "\n";
  std::array<char, 64> text;  // std::to_string() would turn 1e-9 into 0
  std::snprintf(text.data(), text.size(), "range [%.9g:%.9g]\n", limits[0], limits[1]);
  return std::string("set ") + axis + text.data();
}

std::string style(const Series& series) {
  const std::string colour = kPalette[static_cast<std::size_t>(series.colour) % kPalette.size()];
  const std::string line = " lc rgb '" + colour + "'";
  switch (series.mark) {
    case Mark::kDashed:
      return "with lines lw 1.5 dt 2" + line;
    case Mark::kStaircase:
      return "with steps lw 1.5" + line;
    case Mark::kPoints:
      return "with points pt 7 ps 0.5" + line;
    case Mark::kLine:
      break;
  }
  return "with lines lw 1.5" + line;
}

void write_panel(std::string& script, const Panel& panel, std::size_t figure, std::size_t index) {
  for (std::size_t i = 0; i < panel.series.size(); ++i)
    write_data(
        script, block_name(figure, index, i),
        panel.series[i].mark == Mark::kPoints ? panel.series[i].points : thinned(panel.series[i].points));
  script += "set title " + gnuplot_quoted(panel.title) + "\nset xlabel " + gnuplot_quoted(panel.x_label) +
            "\nset ylabel " + gnuplot_quoted(panel.y_label) + "\n";
  script += panel.log_y ? "set logscale y\nset format y '%.0e'\n" : "unset logscale\nset format y '%g'\n";
  script += range("x", panel.x_range) + range("y", panel.y_range);
  script += panel.show_key ? "set key below horizontal Left reverse samplen 1.5 width -1 height 0.6\n"
                           : "unset key\n";
  if (panel.right_label.empty()) {
    script += "unset y2tics\nunset y2label\nset ytics mirror\n";
  } else {
    script += "set ytics nomirror\nset y2tics\nset y2label " + gnuplot_quoted(panel.right_label) + "\n";
  }
  script += "plot ";
  for (std::size_t i = 0; i < panel.series.size(); ++i) {
    const Series& series = panel.series[i];
    script += (i == 0 ? "" : ", ") + block_name(figure, index, i) + " using 1:2 " +
              (series.right_axis ? "axes x1y2 " : "") + style(series) + " " +
              (series.name.empty() ? "notitle" : "title " + gnuplot_quoted(series.name));
  }
  script += "\n";
}

std::string script_of(const Figure& figure, std::size_t index, const std::filesystem::path& directory) {
  const int panels = static_cast<int>(figure.panels.size());
  const int columns = std::min(figure.columns, panels);
  const int rows = (panels + columns - 1) / columns;
  const std::string size = std::to_string(columns * kPanelWidth) + "," + std::to_string(rows * kPanelHeight);
  std::string script =
      "reset\nset encoding utf8\nset terminal svg noenhanced size " + size +
      " fixed font 'sans-serif,12' name '" + figure.id + "' background 'white'\nset output " +
      gnuplot_quoted((directory / (figure.id + ".svg")).string()) + "\nset grid lc rgb '#dddddd'\n";
  script += "set multiplot layout " + std::to_string(rows) + "," + std::to_string(columns) + "\n";
  for (std::size_t i = 0; i < figure.panels.size(); ++i) write_panel(script, figure.panels[i], index, i);
  return script + "unset multiplot\nunset output\n";
}

}  // namespace

void draw_figures(const std::vector<Figure>& figures, const std::filesystem::path& directory) {
  make_folder(directory);
  const std::size_t batches =
      std::min<std::size_t>(figures.size(), std::max(1U, std::thread::hardware_concurrency()));
  run_in_parallel(batches, [&](std::size_t batch) {
    std::string script;
    for (std::size_t i = batch; i < figures.size(); i += batches)
      script += script_of(figures[i], i, directory);
    run_gnuplot(script);
  });
}

Points thinned(const Points& points, std::size_t limit) {
  if (points.size() <= limit) return points;
  const std::size_t groups = limit / 2;
  Points kept;
  kept.reserve(2 * groups + 2);
  kept.push_back(points.front());
  for (std::size_t g = 0; g < groups; ++g) {
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(g * points.size() / groups);
    const auto end = points.begin() + static_cast<std::ptrdiff_t>((g + 1) * points.size() / groups);
    const auto [low, high] =
        std::minmax_element(begin, end, [](const auto& a, const auto& b) { return a.second < b.second; });
    kept.push_back(*std::min(low, high));
    if (low != high) kept.push_back(*std::max(low, high));
  }
  kept.push_back(points.back());
  return kept;
}

}  // namespace strainwave
