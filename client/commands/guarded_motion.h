// Motion that a program orders setpoint by setpoint: whatever ends it before its time ends in a hold. Not real-time.
#pragma once

#include <functional>
#include <string>

#include "client/link/client.h"

namespace strainwave {

/// Runs `motion`. When it throws (also because of Ctrl-C), the joint is told to hold, and the error says so
/// or that it could not be told.
void run_guarded(Client& client, const std::string& joint, const std::function<void()>& motion);

/// Throws ClientError unless the joint is as it must be while a program moves it: the same daemon, heard of
/// within the last half second, enabled, without a fault, no order of this client refused.
void require_undisturbed(Client& client, const std::string& joint, std::int64_t session_id);

}  // namespace strainwave
