// SPDX-License-Identifier: BSD-3-Clause
// The recent values of a joint in watch. Not real-time.
#pragma once

#include <deque>

#include "client/protocol/state_view.h"

namespace strainwave {

/// Values over time, the latest last. NaN while the joint was silent.
struct WatchHistory {
  std::deque<double> position_rad;
  std::deque<double> error_rad;
  std::deque<double> torque_Nm;
  std::deque<double> temperature_C;
};

/// Adds the values of the latest state, and forgets the oldest ones. A state older than kStateSilence_s
/// counts as silence, because its values may be outdated. `age_s`: age of the state.
void remember(const JointView& view, double age_s, WatchHistory& history);

}  // namespace strainwave
