// SPDX-License-Identifier: BSD-3-Clause
// A picture (SVG) of a screen, in the colours of a light or a dark terminal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "client/watch/palette.h"
#include "client/watch/screen.h"

namespace strainwave::testing {

enum class Theme { kLight, kDark };

/// Colours of a cell: indices into xterm's 256 colours.
struct CellColours {
  int foreground;
  int background;
};

inline CellColours colours_of(const Cell& cell, Theme theme) {
  constexpr int kBlack = 16;
  constexpr int kWhite = 231;
  const Paint paint = paint_of(cell.style, Colours::kMany);
  CellColours colours{paint.foreground, paint.background};
  if (colours.foreground < 0) colours.foreground = theme == Theme::kDark ? kWhite : kBlack;
  if (colours.background < 0) colours.background = theme == Theme::kDark ? kBlack : kWhite;
  if (cell.marked) std::swap(colours.foreground, colours.background);
  return colours;
}

/// Red, green and blue of a colour of xterm's cube or grey scale.
inline std::array<int, 3> rgb(int colour) {
  if (colour >= 232) return {8 + 10 * (colour - 232), 8 + 10 * (colour - 232), 8 + 10 * (colour - 232)};
  const auto level = [](int step) { return step == 0 ? 0 : 55 + 40 * step; };
  const int index = colour - 16;
  return {level(index / 36), level(index / 6 % 6), level(index % 6)};
}

/// Relative luminance and contrast ratio (WCAG 2.1).
inline double luminance(int colour) {
  const auto linear = [](int value) {
    const double share = value / 255.0;
    return share <= 0.04045 ? share / 12.92 : std::pow((share + 0.055) / 1.055, 2.4);
  };
  const auto levels = rgb(colour);
  return 0.2126 * linear(levels[0]) + 0.7152 * linear(levels[1]) + 0.0722 * linear(levels[2]);
}
inline double contrast(int a, int b) {
  const double first = luminance(a);
  const double second = luminance(b);
  return (std::max(first, second) + 0.05) / (std::min(first, second) + 0.05);
}

/// `screen` as SVG: one rectangle and one text per cell that is not blank.
inline std::string picture_of(const Screen& screen, Theme theme) {
  constexpr int kWide = 8;
  constexpr int kHigh = 17;
  const auto colour = [](int number) {
    const auto levels = rgb(number);
    return "rgb(" + std::to_string(levels[0]) + "," + std::to_string(levels[1]) + "," +
           std::to_string(levels[2]) + ")";
  };
  const auto place = [](int x, int y) {
    return " x='" + std::to_string(x) + "' y='" + std::to_string(y) + "'";
  };
  const std::string size = " width='" + std::to_string(kWide * screen.columns()) + "' height='" +
                           std::to_string(kHigh * screen.rows()) + "'";
  std::string svg = "<svg xmlns='http://www.w3.org/2000/svg'" + size +
                    " font-family='DejaVu Sans Mono,monospace' font-size='13'>\n<rect" + size + " fill='" +
                    (theme == Theme::kDark ? "black" : "white") + "'/>\n";
  for (int row = 0; row < screen.rows(); ++row) {
    for (int column = 0; column < screen.columns(); ++column) {
      const Cell& cell = screen.at(row, column);
      const CellColours colours = colours_of(cell, theme);
      const bool own_background = cell.marked || paint_of(cell.style, Colours::kMany).background >= 0;
      if (own_background)
        svg += "<rect" + place(kWide * column, kHigh * row) + " width='" + std::to_string(kWide) +
               "' height='" + std::to_string(kHigh) + "' fill='" + colour(colours.background) + "'/>";
      if (cell.glyph == " ") continue;
      const std::string glyph = cell.glyph == "<"   ? "&lt;"
                                : cell.glyph == ">" ? "&gt;"
                                : cell.glyph == "&" ? "&amp;"
                                                    : cell.glyph;
      svg += "<text" + place(kWide * column, kHigh * row + 13) + " fill='" + colour(colours.foreground) +
             "'" + (paint_of(cell.style, Colours::kMany).bold ? " font-weight='bold'" : "") + ">" + glyph +
             "</text>";
    }
    svg += "\n";
  }
  return svg + "</svg>\n";
}

}  // namespace strainwave::testing
