// SPDX-License-Identifier: BSD-3-Clause
// Orders to one joint: one message each, its answer, and where there is one the mode that follows. Throw ClientError: Refused,
// NoAnswer, Faulted, NotDone. Not real-time.
#pragma once

#include <strainwave/command_v1.hpp>
#include <string>
#include <vector>

#include "client/protocol/client.h"
#include "strainwave/client_error.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

/// A state that left the daemon before it took the order may still arrive after the acknowledgement.
inline constexpr double kOldStates_s = 0.2;

Mode mode_of(const JointView& view);

/// The joint, which is heard, has a latched fault, in words and as an error.
Faulted faulted(const Client& client, const std::string& joint);

/// The joint has yielded to a load since it was last set moving (docs/faults.md, "Contact"); likewise. `undone`: what came of it, in words.
bool has_yielded(const JointView& view);
Yielded yielded(const std::string& joint, const std::string& undone, const JointView& view);

/// What went wrong with each of several joints, a line for each.
std::string lines_of(const std::vector<ClientError>& errors);

/// Throws Refused with the reason unless `answer` accepts what `what` names.
void require_accepted(const Answer& answer, const std::string& joint, const std::string& what,
                      const std::string& hint = "");

command_v1 command_message(Action action);

/// Sends `action`, which has to be accepted.
void order_accepted(Client& client, const std::string& joint, Action action);

/// Returns once the joint holds. False: it was enabled already, and nothing was sent.
bool enable_joint(Client& client, const std::string& joint);

/// Leaves a latched fault. False: there was none, and nothing was sent.
bool clear_joint_fault(Client& client, const std::string& joint);

/// Returns once the joint shows no fault any more.
void wait_until_cleared(Client& client, const std::string& joint);

/// Sends a disable or hold, without waiting for a state; that it was sent is said whatever comes of it.
void send_stop(Client& client, const std::string& joint, Action stop);

/// Returns once the joint is off.
void wait_until_off(Client& client, const std::string& joint);

}  // namespace strainwave
