// SPDX-License-Identifier: BSD-3-Clause
// The lower part of the watch screen: everything about the selected joint, and its last minutes. Pure. Not real-time.
#pragma once

#include "client/watch/view.h"

namespace strainwave {

/// Fills the rows from `first` to before `end`, or as many of them as there is something to say.
void draw_detail(const WatchModel& model, const WatchedJoint& joint, Screen& screen, int first, int end);

/// What error, torque, position and temperature must at least span in a plot: a share of the joint's own limits.
struct PlotSpans {
  double error_rad = 1e-4;
  double torque_Nm = 1.0;
  double position_rad = 1e-3;
  double temperature_C = 1.0;
};
PlotSpans plot_spans(const WatchedJoint& joint);

}  // namespace strainwave
