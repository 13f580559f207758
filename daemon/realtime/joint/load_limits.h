// SPDX-License-Identifier: BSD-3-Clause
// The load above which a joint yields, and the load above which there is a notice. Real-time safe. Joint side, N.m.
#pragma once

#include <optional>

namespace strainwave {

struct LoadLimits {
  double load_Nm = 0.0;    ///< > 0; the joint yields to a larger load that lasts for overload_s
  double notice_Nm = 0.0;  ///< > 0, at most load_Nm
};

/// Loads from which the default load limit of a joint follows. All >= 0.
struct UsualLoad {
  double gravity_Nm = 0.0;       ///< largest torque of gravity
  double accelerating_Nm = 0.0;  ///< motor and link together, larger of acceleration and deceleration
  double configured_Nm = 0.0;    ///< to carry (initial_load_Nm), or to press with (stop_torque_Nm)

  /// The load limit, from torque limit L, acceleration A and gravity G. The joint then yields before a push takes all of the torque:
  ///
  ///   L - G - A   [N.m], clamped to 0.5 ... 0.8 of L - G
  ///
  /// and at least a tenth of L and 1.25 times the configured load. > 0 for `torque_limit_Nm` > 0, even if that is below G.
  double limit_Nm(double torque_limit_Nm) const noexcept;
};

/// The load limits in a joint's configuration.
struct LoadLimitConfig {
  std::optional<double> load_Nm;    ///< none: usual.limit_Nm()
  std::optional<double> notice_Nm;  ///< none: 0.8 of the load limit
  UsualLoad usual;

  /// The limits for a torque limit > 0, the lower of the joint's and its table's.
  LoadLimits under(double torque_limit_Nm) const noexcept;
};

}  // namespace strainwave
