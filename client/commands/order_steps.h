// What the orders of strainwavectl share: one message, its answer, and how a joint that faulted is told of. Not real-time.
#pragma once

#include <strainwave/command_v1.hpp>
#include <string>

#include "client/link/client.h"
#include "client/link/exit_status.h"
#include "lcmtypes/vocabulary.h"

namespace strainwave {

/// A state that left the daemon before it took the order may still arrive after the acknowledgement.
inline constexpr double kOldStates_s = 0.2;

Mode mode_of(const JointView& view);

command_v1 command_message(Action action);

/// Sends `action`, which has to be accepted. Throws ClientError (refused, no answer).
void order_accepted(Client& client, const std::string& joint, Action action);

ClientError faulted(const std::string& joint, const JointView& view);

}  // namespace strainwave
