// SPDX-License-Identifier: BSD-3-Clause
// The terminal, through ncurses, which only this class uses. Not real-time.
#pragma once

#include <optional>

#include "client/watch/palette.h"
#include "client/watch/screen.h"

namespace strainwave {

/// Uses the whole terminal during its lifetime.
class Terminal {
 public:
  enum class Key { kUp, kDown, kResize, kOther };
  struct Press {
    Key key = Key::kOther;
    char character = '\0';  ///< the character of kOther, 0 if unknown
  };

  /// Throws ClientError (usage) when the terminal does not support a full screen.
  Terminal();
  ~Terminal();
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;

  int rows() const;
  int columns() const;
  bool unicode() const noexcept { return unicode_; }
  void show(const Screen& screen);
  /// Returns the next key that was pressed, if any. It does not wait.
  std::optional<Press> read();

 private:
  bool unicode_ = false;
  Colours colours_ = Colours::kNone;
};

}  // namespace strainwave
