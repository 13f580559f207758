// SPDX-License-Identifier: BSD-3-Clause
// The terminal, by ncurses: the only file that knows it. Not real-time.
#pragma once

#include <optional>

#include "client/watch/palette.h"
#include "client/watch/screen.h"

namespace strainwave {

/// Takes the whole terminal as long as it lives.
class Terminal {
 public:
  enum class Key { kUp, kDown, kResize, kOther };
  struct Press {
    Key key = Key::kOther;
    char character = '\0';  ///< kOther: the character, 0 for none that we know
  };

  /// Throws ClientError (usage) when the terminal cannot be used that way.
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  int rows() const;
  int columns() const;
  bool unicode() const noexcept { return unicode_; }
  void show(const Screen& screen);
  /// The next key that was pressed, or nothing; does not wait.
  std::optional<Press> read();

 private:
  bool unicode_ = false;
  Colours colours_ = Colours::kNone;
};

}  // namespace strainwave
