// SPDX-License-Identifier: BSD-3-Clause
#include "client/watch/history.h"

#include <limits>

#include "client/text/text.h"

namespace strainwave {

namespace {

constexpr std::size_t kHistory = 512;  // two for each character of the widest terminal

void add(std::deque<double>& values, double value) {
  values.push_back(value);
  if (values.size() > kHistory) values.pop_front();
}

}  // namespace

void remember(const JointView& view, double age_s, WatchHistory& history) {
  const auto heard = [silent = age_s > kStateSilence_s](double value) {
    return silent ? std::numeric_limits<double>::quiet_NaN() : value;
  };
  const state_v1& state = view.state;
  add(history.position_rad, heard(state.joint_position_rad));
  add(history.error_rad, heard(tracking_error_rad(view)));
  add(history.torque_Nm, heard(state.torque_applied_Nm));
  add(history.temperature_C, heard(state.temperature_used_C));
}

}  // namespace strainwave
