// joint.limits.load_Nm and load_notice_Nm: from what load on the joint yields, and from what on there is notice. Not real-time.
#pragma once

#include "base/toml_section.h"
#include "daemon/config/config.h"

namespace strainwave {

/// The load above which a joint yields that is given no load_Nm: what torque limit L leaves a joint that accelerates as configured and holds
/// its weight G, so that a push is yielded to before it has taken all of the torque,
///
///   L - G - J a   [N.m], within 0.5 and 0.8 of L - G
///
/// J kg.m^2 motor and link together, a rad/s^2 the harder of acceleration and deceleration; and at least a tenth of L, and a quarter more than the
/// joint is told to carry (initial_load_Nm) or to press with (stop_torque_Nm). Joint side, > 0.
double usual_load_limit_Nm(const JointConfig& joint);

/// Reads both of [joint.limits] into `joint`, of which all else that usual_load_limit_Nm() asks for is known. Throws InputError.
void read_load_limits(TomlSection& limits, JointConfig& joint);

}  // namespace strainwave
