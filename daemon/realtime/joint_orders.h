// SPDX-License-Identifier: BSD-3-Clause
// What a joint makes of an order. Real-time safe.
#pragma once

#include <span>

#include "daemon/realtime/joint_in_loop.h"

namespace strainwave {

/// Obeys or refuses. `tables`: the slots that kUseTable names.
Ruling obey(JointInLoop& joint, const Order& order, const CycleTime& time,
            std::span<const TableSlot> tables) noexcept;

}  // namespace strainwave
