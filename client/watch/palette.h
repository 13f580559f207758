// SPDX-License-Identifier: BSD-3-Clause
// The appearance of each style. One palette serves light and dark terminals: text on the terminal's
// background has a middle tone, and important text has its own background. Not real-time.
#pragma once

#include "client/watch/screen.h"

namespace strainwave {

enum class Colours { kNone, kEight, kMany };  ///< kMany: the 256 of xterm

/// Colours by their numbers in xterm; -1 is the terminal's default.
struct Paint {
  int foreground = -1;
  int background = -1;
  bool bold = false;
  bool dim = false;
  bool underlined = false;
};

/// The styles are distinct with any number of colours, except that kPlain and kGood may look alike.
Paint paint_of(Style style, Colours colours) noexcept;

}  // namespace strainwave
