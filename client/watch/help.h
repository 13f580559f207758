// SPDX-License-Identifier: BSD-3-Clause
// The help text of watch: its keys and its columns. Not real-time.
#pragma once

#include "client/watch/screen.h"

namespace strainwave {

/// Draws the help into the rows [`first`, `end`). On a small terminal the last line says that the rest is left out.
void draw_help(Screen& screen, int first, int end);

}  // namespace strainwave
