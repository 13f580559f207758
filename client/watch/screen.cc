// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/screen.h"

#include <algorithm>

#include "client/text/text.h"

namespace strainwave {

Screen::Screen(int rows, int columns)
    : rows_(std::max(0, rows)),
      columns_(std::max(0, columns)),
      cells_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(columns_)) {}

const Cell& Screen::at(int row, int column) const {
  return cells_.at(static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                   static_cast<std::size_t>(column));
}

int Screen::put(int row, int column, std::string_view text, Style style, bool marked) {
  for (std::size_t i = 0; i < text.size(); ++column) {
    std::size_t length = 1;
    while (i + length < text.size() && (static_cast<unsigned char>(text[i + length]) & 0xC0U) == 0x80U)
      ++length;
    if (row >= 0 && row < rows_ && column >= 0 && column < columns_)
      cells_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
             static_cast<std::size_t>(column)] = {std::string(text.substr(i, length)), style, marked};
    i += length;
  }
  return column;
}

void Screen::put_fitting(int row, int column, std::string_view text, Style style) {
  const int room = columns_ - column;
  if (room > 3) put(row, column, wrapped(text, static_cast<std::size_t>(room), 1).front(), style);
}

std::string Screen::text(int row) const {
  std::string line;
  for (int column = 0; column < columns_; ++column) line += at(row, column).glyph;
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

}  // namespace strainwave
