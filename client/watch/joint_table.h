// SPDX-License-Identifier: BSD-3-Clause
// The table of joints of watch. Not real-time.
#pragma once

#include "client/watch/view.h"

namespace strainwave {

/// Draws a title and up to `count` - 1 joints, from row `first` on. The selected joint stays visible. On a
/// narrow screen the less important columns are left out.
void draw_joints(const WatchModel& model, Screen& screen, int first, int count);

}  // namespace strainwave
