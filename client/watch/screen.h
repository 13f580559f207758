// SPDX-License-Identifier: BSD-3-Clause
// A screen of characters without a terminal: the view draws on it, and tests inspect it. Not real-time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace strainwave {

enum class Style { kPlain, kDim, kTitle, kGood, kWarning, kAlarm };

struct Cell {
  std::string glyph = " ";  ///< one character in UTF-8, one column wide
  Style style = Style::kPlain;
  bool marked = false;  ///< part of the selection: shown reversed, in its own colours
  bool operator==(const Cell&) const = default;
};

class Screen {
 public:
  /// Negative sizes count as 0.
  Screen(int rows, int columns);

  int rows() const noexcept { return rows_; }
  int columns() const noexcept { return columns_; }
  const Cell& at(int row, int column) const;

  /// Writes `text` (UTF-8) from a place on, and leaves out the part outside. Returns the column after the text.
  int put(int row, int column, std::string_view text, Style style = Style::kPlain, bool marked = false);
  /// Writes `text` likewise. If it does not fit it ends in dots, because a cut number would look like another number.
  void put_fitting(int row, int column, std::string_view text, Style style = Style::kPlain);
  /// A row as text, without trailing spaces.
  std::string text(int row) const;
  bool operator==(const Screen&) const = default;

 private:
  int rows_;
  int columns_;
  std::vector<Cell> cells_;
};

}  // namespace strainwave
