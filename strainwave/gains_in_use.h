// SPDX-License-Identifier: BSD-3-Clause
// Which of a table's gains a joint is controlled by. Real-time safe.
#pragma once

namespace strainwave {

enum class GainsInUse : int { kNone = 0, kPrimary = 1, kFallback = 2 };

}  // namespace strainwave
