// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/terminal.h"

#include <curses.h>
#include <langinfo.h>

#include <array>
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <string_view>

#include "strainwave/client_error.h"

namespace strainwave {

namespace {

SCREEN* opened = nullptr;

constexpr std::array kStyles{Style::kPlain, Style::kDim,     Style::kTitle,
                             Style::kGood,  Style::kWarning, Style::kAlarm};

/// The colours of the terminal. A user can refuse colours with NO_COLOR (no-color.org).
Colours available_colours() {
  const char* const refused = std::getenv("NO_COLOR");  // NOLINT(concurrency-mt-unsafe): one thread
  if (!has_colors() || (refused != nullptr && *refused != '\0')) return Colours::kNone;
  return COLORS >= 256 ? Colours::kMany : Colours::kEight;
}

short pair_of(Style style) {
  return static_cast<short>(1 + static_cast<int>(style));
}

attr_t attributes(const Cell& cell, Colours colours) {
  const Paint paint = paint_of(cell.style, colours);
  attr_t result = A_NORMAL;
  if (paint.bold) result |= A_BOLD;
  if (paint.dim) result |= A_DIM;
  if (paint.underlined) result |= A_UNDERLINE;
  if (cell.marked) result |= A_REVERSE;
  if (colours != Colours::kNone) result |= static_cast<attr_t>(COLOR_PAIR(pair_of(cell.style)));
  return result;
}

}  // namespace

Terminal::Terminal() {
  std::setlocale(LC_CTYPE, "");  // NOLINT(concurrency-mt-unsafe): one thread
  unicode_ = std::string_view(::nl_langinfo(CODESET)) == "UTF-8";  // NOLINT(concurrency-mt-unsafe)
  // initscr() would end the program on an unknown terminal.
  opened = ::newterm(nullptr, stdout, stdin);
  if (opened == nullptr)
    throw ClientError(ExitStatus::kUsage,
                      "watch does not know this type of terminal (TERM): use watch --plain");
  ::cbreak();
  ::noecho();
  ::nonl();
  ::keypad(stdscr, TRUE);
  ::nodelay(stdscr, TRUE);
  ::curs_set(0);
  if (has_colors()) {
    ::start_color();
    ::use_default_colors();
  }
  colours_ = available_colours();
  for (const Style style : kStyles) {
    const Paint paint = paint_of(style, colours_);
    if (colours_ != Colours::kNone)
      ::init_pair(pair_of(style), static_cast<short>(paint.foreground), static_cast<short>(paint.background));
  }
}

Terminal::~Terminal() {
  ::endwin();
  ::delscreen(opened);
}

int Terminal::rows() const {
  return getmaxy(stdscr);
}

int Terminal::columns() const {
  return getmaxx(stdscr);
}

void Terminal::show(const Screen& screen) {
  for (int row = 0; row < screen.rows(); ++row) {
    ::move(row, 0);
    for (int column = 0; column < screen.columns(); ++column) {
      const Cell& cell = screen.at(row, column);
      ::attrset(static_cast<int>(attributes(cell, colours_)));
      ::addstr(cell.glyph.c_str());
    }
  }
  ::refresh();
}

std::optional<Terminal::Press> Terminal::read() {
  const int code = ::getch();
  if (code == ERR) return std::nullopt;
  if (code == KEY_UP) return Press{Key::kUp, '\0'};
  if (code == KEY_DOWN) return Press{Key::kDown, '\0'};
  if (code == KEY_RESIZE) return Press{Key::kResize, '\0'};
  return Press{Key::kOther, code > 0 && code < 128 ? static_cast<char>(code) : '\0'};
}

}  // namespace strainwave
