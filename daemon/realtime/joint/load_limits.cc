// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/load_limits.h"

#include <algorithm>

namespace strainwave {

namespace {

// Shares of the torque that gravity leaves. A joint that needs all of its torque to accelerate still carries half of it; one that hardly
// accelerates keeps a fifth, to slow down what pushes it.
constexpr double kLeastLoad = 0.5;
constexpr double kLargestLoad = 0.8;
// Of the torque limit: what a table's friction is off by is no load, even where the weight takes all of the torque.
constexpr double kLeastOfAll = 0.1;
// Above the configured load.
constexpr double kRoom = 1.25;
// Of the largest load: what calls for a notice.
constexpr double kHighLoad = 0.8;

}  // namespace

double UsualLoad::limit_Nm(double torque_limit_Nm) const noexcept {
  // A table may have less torque than the joint weighs.
  const double left_Nm = std::max(0.0, torque_limit_Nm - gravity_Nm);
  return std::max({std::clamp(left_Nm - accelerating_Nm, kLeastLoad * left_Nm, kLargestLoad * left_Nm),
                   kLeastOfAll * torque_limit_Nm, kRoom * configured_Nm});
}

// A notice that comes after the joint has yielded would be none.
LoadLimits LoadLimitConfig::under(double torque_limit_Nm) const noexcept {
  const double most_Nm = load_Nm ? *load_Nm : usual.limit_Nm(torque_limit_Nm);
  return {most_Nm, notice_Nm ? std::min(*notice_Nm, most_Nm) : kHighLoad * most_Nm};
}

}  // namespace strainwave
