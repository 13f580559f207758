// SPDX-License-Identifier: BSD-3-Clause
// How long a setpoint of a stream may stay valid when no newer one comes. Not real-time.
#pragma once

namespace strainwave {

/// The largest setpoint_v1.valid_for_s that the daemon accepts. A joint without new samples rests long before that, with the torque of
/// its last sample.
inline constexpr double kLongestValidFor_s = 10.0;

}  // namespace strainwave
