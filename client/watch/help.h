// SPDX-License-Identifier: BSD-3-Clause
// The keys of watch and what it shows, in words. Not real-time.
#pragma once

#include "client/watch/screen.h"

namespace strainwave {

/// Into rows [`first`, `end`). What a small terminal has no room for is left out, and it says so.
void draw_help(Screen& screen, int first, int end);

}  // namespace strainwave
