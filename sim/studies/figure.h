// SPDX-License-Identifier: BSD-3-Clause
// Figures, described as data and drawn by gnuplot as SVG. Offline.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace strainwave {

using Points = std::vector<std::pair<double, double>>;

enum class Mark { kLine, kDashed, kStaircase, kPoints };

/// One curve.
struct Series {
  std::string name;  ///< name in the key; empty: not listed
  Points points;
  Mark mark = Mark::kLine;
  int colour = 0;  ///< index into the palette
  bool right_axis = false;
};

struct Panel {
  std::string title;
  std::string x_label;
  std::string y_label;
  std::string right_label;  ///< label of the right axis, if a series uses it
  std::vector<Series> series;
  bool log_y = false;
  std::vector<double> x_range;  ///< empty, or two numbers
  std::vector<double> y_range;
  bool show_key = true;
};

struct Figure {
  std::string id;  ///< file name without ".svg"
  std::string caption;
  int columns = 1;  ///< panels per row
  std::vector<Panel> panels;
};

/// Draws each figure into `directory`/<id>.svg, with several gnuplot processes at once. Throws InputError
/// with gnuplot's message if gnuplot is missing or fails.
void draw_figures(const std::vector<Figure>& figures, const std::filesystem::path& directory);

/// Returns at most about `limit` points, which include the smallest and the largest of each group, in order.
Points thinned(const Points& points, std::size_t limit = 400);

}  // namespace strainwave
