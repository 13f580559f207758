// SPDX-License-Identifier: BSD-3-Clause
// From what load on a joint yields, and from what on there is notice. Real-time safe. Joint side, N.m.
#pragma once

#include <optional>

namespace strainwave {

struct LoadLimits {
  double load_Nm = 0.0;    ///< > 0; the joint yields to a larger one that shows for overload_s
  double notice_Nm = 0.0;  ///< > 0, at most load_Nm
};

/// What the limit of a joint follows from that is given none. All >= 0.
struct UsualLoad {
  double gravity_Nm = 0.0;       ///< the joint's weight, at its most
  double accelerating_Nm = 0.0;  ///< motor and link together, the harder of acceleration and deceleration
  double configured_Nm = 0.0;    ///< to carry (initial_load_Nm) or to press with (stop_torque_Nm)

  /// With what torque limit L leaves besides acceleration A and weight G a push is yielded to before it has taken all of the torque:
  ///
  ///   L - G - A   [N.m], within 0.5 and 0.8 of L - G
  ///
  /// and at least a tenth of L, and 1.25 times the configured load. > 0 for `torque_limit_Nm` > 0, also where that is less than
  /// the weight.
  double limit_Nm(double torque_limit_Nm) const noexcept;
};

/// What a joint's configuration says of its load.
struct LoadLimitConfig {
  std::optional<double> load_Nm;    ///< none: the usual one
  std::optional<double> notice_Nm;  ///< none: 0.8 of the largest load
  UsualLoad usual;

  /// Under the lower of the joint's and its table's torque limit, > 0.
  LoadLimits under(double torque_limit_Nm) const noexcept;
};

}  // namespace strainwave
