// SPDX-License-Identifier: BSD-3-Clause
// How long a stream's setpoint may stand for one that does not come. Not real-time.
#pragma once

namespace strainwave {

/// The largest setpoint_v1.valid_for_s. It holds for a stream that gives none: the joint rests by then, and the torque of its last sample
/// stays. Twice what an owner may be silent for.
inline constexpr double kLongestValidFor_s = 10.0;

}  // namespace strainwave
