// SPDX-License-Identifier: BSD-3-Clause
// A chart as SVG for a page of HTML: axes, curves and points with their intervals. The page sets the colours by CSS classes. Pure; not
// real-time.
#pragma once

#include <string>
#include <vector>

namespace strainwave {

struct ChartPoint {
  double x = 0.0;
  double y = 0.0;
  double half_width = 0.0;  ///< of y's interval; 0: none is drawn
};

struct ChartCurve {
  std::string label;
  std::vector<ChartPoint>
      points;  ///< by rising x; points that are not finite, or not above 0 on a logarithmic axis, are left out
  bool line = true;  ///< false: points only
};

struct Chart {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool x_logarithmic = false;
  bool y_logarithmic = false;
  std::vector<ChartCurve> curves;  ///< curve i has the class "curve i"
};

/// `text` escaped, so that HTML shows it literally.
std::string html_text(const std::string& text);

/// The element <svg>, labels escaped. Empty if no curve has a point.
std::string to_svg(const Chart& chart);

}  // namespace strainwave
