#include "client/watch/terminal.h"

#include <curses.h>
#include <langinfo.h>

#include <clocale>
#include <cstdio>
#include <string_view>

#include "client/link/exit_status.h"

namespace strainwave {

namespace {

SCREEN* opened = nullptr;

/// Attributes stay useful on a terminal without colours.
attr_t attributes(Style style) {
  const auto colour = [](short pair) {
    return has_colors() ? static_cast<attr_t>(COLOR_PAIR(pair)) : attr_t{A_NORMAL};
  };
  switch (style) {
    case Style::kPlain:
      return A_NORMAL;
    case Style::kDim:
      return A_DIM;
    case Style::kTitle:
      return A_BOLD;
    case Style::kGood:
      return colour(1);
    case Style::kWarning:
      return colour(2) | A_BOLD;
    case Style::kAlarm:
      return colour(3) | A_BOLD;
    case Style::kSelected:
      return A_REVERSE;
  }
  return A_NORMAL;
}

}  // namespace

Terminal::Terminal() {
  std::setlocale(LC_CTYPE, "");  // NOLINT(concurrency-mt-unsafe): one thread
  unicode_ = std::string_view(::nl_langinfo(CODESET)) == "UTF-8";  // NOLINT(concurrency-mt-unsafe)
  // Not initscr(): that ends the program when the terminal is not known.
  opened = ::newterm(nullptr, stdout, stdin);
  if (opened == nullptr)
    throw ClientError(ExitStatus::kUsage,
                      "this terminal cannot be used as a whole (TERM is not known): say watch --plain");
  ::cbreak();
  ::noecho();
  ::nonl();
  ::keypad(stdscr, TRUE);
  ::nodelay(stdscr, TRUE);
  ::curs_set(0);
  if (has_colors()) {
    ::start_color();
    ::use_default_colors();
    ::init_pair(1, COLOR_GREEN, -1);
    ::init_pair(2, COLOR_YELLOW, -1);
    ::init_pair(3, COLOR_RED, -1);
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
      ::attrset(static_cast<int>(attributes(cell.style)));
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
