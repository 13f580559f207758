// SPDX-License-Identifier: BSD-3-Clause
#include "client/protocol/state_view.h"

#include <fmt/format.h>

#include <algorithm>

#include "client/protocol/plain_zero.h"
#include "lcmtypes/cycle_fields.h"

namespace strainwave {

void JointView::take(const state_v1& latest) {
  if (messages > 0 && latest.session_id != state.session_id) {
    two_daemons = two_daemons || latest.session_id == previous_session;
    previous_session = state.session_id;
  }
  if (messages > 0 && latest.fault != 0 && state.fault == 0) fault_challenge = latest.challenge;
  state = latest;
  received = now();
  ++messages;
}

std::string silence_of(const JointView& view, double timeout_s) {
  constexpr double kLongest_s = 0.5;  // states come at least ten times a second
  const double silent_s = seconds_between(view.received, now());
  if (silent_s < std::min(kLongest_s, timeout_s)) return "";
  return fmt::format("no state for {:.1f} s", silent_s);
}

double tracking_error_rad(const JointView& view) noexcept {
  return plain_zero(tracking_error_rad(view.state));
}

std::vector<std::string> StateView::joints(const std::string& prefix) const {
  std::vector<std::string> names;
  for (const auto& [name, view] : latest_.all()) {
    if (name.first == prefix) names.push_back(name.second);
  }
  return names;
}

std::vector<std::string> StateView::prefixes() const {
  std::vector<std::string> names;
  for (const auto& [name, view] : latest_.all()) {
    if (names.empty() || names.back() != name.first) names.push_back(name.first);
  }
  return names;
}

}  // namespace strainwave
