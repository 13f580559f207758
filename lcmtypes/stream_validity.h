// How long a stream's setpoint may stand for one that does not come. Not real-time.
#pragma once

namespace strainwave {

/// At most this, of setpoint_v2.valid_for_s. Of a stream that says nothing: the joint rests by then, and the torque it was told of stays.
/// Twice what an owner may be silent for.
inline constexpr double kLongestValidFor_s = 10.0;

}  // namespace strainwave
