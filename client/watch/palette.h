// SPDX-License-Identifier: BSD-3-Clause
// What each style looks like. One palette that is read on light and on dark terminals: what stands on the terminal's own
// background has a middle tone, what must be seen brings its background with it. Not real-time.
#pragma once

#include "client/watch/screen.h"

namespace strainwave {

enum class Colours { kNone, kEight, kMany };  ///< kMany: the 256 of xterm

/// Colours by their numbers in xterm; -1 is the terminal's own.
struct Paint {
  int foreground = -1;
  int background = -1;
  bool bold = false;
  bool dim = false;
  bool underlined = false;
};

/// Every style differs from every other, with any number of colours.
Paint paint_of(Style style, Colours colours) noexcept;

}  // namespace strainwave
