// SPDX-License-Identifier: BSD-3-Clause
// The table of joints of watch. Not real-time.
#pragma once

#include "client/watch/view.h"

namespace strainwave {

/// A title and up to `count` - 1 joints, from row `first` on. The selected joint stays in sight. Columns that do not fit are left out,
/// the most important ones stay.
void draw_joints(const WatchModel& model, Screen& screen, int first, int count);

}  // namespace strainwave
