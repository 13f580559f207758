// SPDX-License-Identifier: BSD-3-Clause
// A joint's part of a path, as daemon/realtime/path_follower.h leads it. Real-time safe.
#pragma once

#include <cstdint>

#include "daemon/realtime/joint_in_loop.h"

namespace strainwave {

/// Takes over the part of a path that kLoadPath brings.
Ruling take_path(JointInLoop& joint, const Order& order) noexcept;
/// Whether the joint could begin `path` in this cycle: it holds where the path begins.
Ruling may_begin_path(const JointInLoop& joint, const LoadedPath& path) noexcept;
void begin_path(JointInLoop& joint, const CycleTime& time) noexcept;
/// Where the joint is to be `in_periods` after the begin of this one.
void follow_path(JointInLoop& joint, const PathPoint& point, std::int64_t in_periods) noexcept;
/// Comes to rest by itself, off the path.
void stop_beside_path(JointInLoop& joint) noexcept;

}  // namespace strainwave
