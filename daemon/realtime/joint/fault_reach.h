// SPDX-License-Identifier: BSD-3-Clause
// What a joint's fault says of the joints that are on a path with it, or in its group: whether they may come to rest along their path. Stop first is
// the rule: along the path only where the fault is of the joint's own parts, and nothing has run into anything. docs/faults.md says why, fault by
// fault. Real-time safe.
#pragma once

#include <cstdint>

#include "strainwave/vocabulary.h"

namespace strainwave {

/// How the other joints stop with a joint.
enum class OthersStop {
  kAlongPath,  ///< where they are on one
  kAtOnce,     ///< as quickly as each can
};

/// `drive_error` as state_v1 has it: of an implausible reading the cause.
OthersStop others_stop(Fault fault, std::uint32_t drive_error) noexcept;

}  // namespace strainwave
