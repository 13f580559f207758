// SPDX-License-Identifier: BSD-3-Clause
// Orders to one joint: one message each, its answer, and the resulting mode, if any. They throw ClientError:
// Refused, NoAnswer, Faulted, NotDone. Not real-time.
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

/// The error for a joint with a latched fault, in words. The joint must be heard.
Faulted faulted(const Client& client, const std::string& joint);

/// Whether the joint yielded to a load since its last start of motion (docs/faults.md, "Contact"). `undone`: the failed action.
bool has_yielded(const JointView& view);
Yielded yielded(const std::string& joint, const std::string& undone, const JointView& view);

/// The messages of errors of several joints, one line each.
std::string lines_of(const std::vector<ClientError>& errors);

/// Throws Refused with the reason unless `answer` is an acceptance. `what` names the order.
void require_accepted(const Answer& answer, const std::string& joint, const std::string& what,
                      const std::string& hint = "");

command_v1 command_message(Action action);

/// Sends `action`. Throws unless the daemon accepts it.
void order_accepted(Client& client, const std::string& joint, Action action);

/// Returns once the joint is enabled. The result is false if it was enabled already; then nothing is sent.
bool enable_joint(Client& client, const std::string& joint);

/// Clears a latched fault. Returns false if there was none; then nothing is sent.
bool clear_joint_fault(Client& client, const std::string& joint);

/// Returns once the joint shows no fault.
void wait_until_cleared(Client& client, const std::string& joint);

/// Sends a disable or hold without waiting for a state. If no answer comes, the error says that the stop was sent.
void send_stop(Client& client, const std::string& joint, Action stop);

/// Returns once the joint is off.
void wait_until_off(Client& client, const std::string& joint);

}  // namespace strainwave
