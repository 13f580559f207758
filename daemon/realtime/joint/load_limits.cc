// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/load_limits.h"

#include <algorithm>

namespace strainwave {

namespace {

// Shares of the torque that gravity leaves. A joint that needs all of it to accelerate may still carry half of it. One that hardly
// accelerates keeps a fifth of it, to decelerate a push.
constexpr double kLeastLoad = 0.5;
constexpr double kLargestLoad = 0.8;
// Share of the torque limit: an error of the table's friction is not a load, even if the weight takes all of the torque.
constexpr double kLeastOfAll = 0.1;
// Factor above the configured load.
constexpr double kRoom = 1.25;
// Share of the load limit above which there is a notice.
constexpr double kHighLoad = 0.8;

}  // namespace

double UsualLoad::limit_Nm(double torque_limit_Nm) const noexcept {
  // A table's torque limit may be below the torque of gravity.
  const double left_Nm = std::max(0.0, torque_limit_Nm - gravity_Nm);
  return std::max({std::clamp(left_Nm - accelerating_Nm, kLeastLoad * left_Nm, kLargestLoad * left_Nm),
                   kLeastOfAll * torque_limit_Nm, kRoom * configured_Nm});
}

// Above the load limit a notice would come too late: the joint has yielded.
LoadLimits LoadLimitConfig::under(double torque_limit_Nm) const noexcept {
  const double most_Nm = load_Nm ? *load_Nm : usual.limit_Nm(torque_limit_Nm);
  return {most_Nm, notice_Nm ? std::min(*notice_Nm, most_Nm) : kHighLoad * most_Nm};
}

}  // namespace strainwave
