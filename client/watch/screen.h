// SPDX-License-Identifier: BSD-3-Clause
// A screen of characters, without a terminal: what the view is drawn on, and what a test looks at. Not real-time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

enum class Style { kPlain, kDim, kTitle, kGood, kWarning, kAlarm };

struct Cell {
  std::string glyph = " ";  ///< one character in UTF-8, one column wide
  Style style = Style::kPlain;
  bool marked = false;  ///< of what is selected: reversed, in its own colours
  bool operator==(const Cell&) const = default;
};

class Screen {
 public:
  /// Both are taken as at least 0.
  Screen(int rows, int columns);

  int rows() const noexcept { return rows_; }
  int columns() const noexcept { return columns_; }
  const Cell& at(int row, int column) const;

  /// Writes `text` (UTF-8) from a place on; what lies outside is left out. Returns the column behind it.
  int put(int row, int column, std::string_view text, Style style = Style::kPlain, bool marked = false);
  /// Likewise; what the row has no room for ends in dots, since a number that is cut would be another one.
  void put_fitting(int row, int column, std::string_view text, Style style = Style::kPlain);
  /// A row as text, without the blanks at its end.
  std::string text(int row) const;
  bool operator==(const Screen&) const = default;

 private:
  int rows_;
  int columns_;
  std::vector<Cell> cells_;
};

}  // namespace strainwave
