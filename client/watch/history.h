// SPDX-License-Identifier: BSD-3-Clause
// What watch has seen of a joint over time. Not real-time.
#pragma once

#include <deque>

#include "client/protocol/state_view.h"

namespace strainwave {

/// Over time, the latest last; not a number where the joint was silent.
struct WatchHistory {
  std::deque<double> position_rad;
  std::deque<double> error_rad;
  std::deque<double> torque_Nm;
  std::deque<double> temperature_C;
};

/// Adds what the joint says now, and forgets the oldest. What a joint said that is silent is not what it does: `age_s` is that of the
/// state.
void remember(const JointView& view, double age_s, WatchHistory& history);

}  // namespace strainwave
