// SPDX-License-Identifier: BSD-3-Clause
// The lower part of the watch screen: details of the selected joint, and plots of its recent values. Pure. Not real-time.
#pragma once

#include "client/watch/view.h"

namespace strainwave {

/// Fills the rows [`first`, `end`), or fewer if there is less to show.
void draw_detail(const WatchModel& model, const WatchedJoint& joint, Screen& screen, int first, int end);

/// The smallest spans of the plots, as shares of the joint's limits.
struct PlotSpans {
  double error_rad = 1e-4;
  double torque_Nm = 1.0;
  double position_rad = 1e-3;
  double temperature_C = 1.0;
};
PlotSpans plot_spans(const WatchedJoint& joint);

}  // namespace strainwave
