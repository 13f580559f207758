// SPDX-License-Identifier: BSD-3-Clause
// Motion that a program orders setpoint by setpoint: whatever ends it before its time ends in a hold. Not real-time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "client/protocol/client.h"
#include "client/protocol/orders.h"

namespace strainwave {

/// Runs `motion`. When it throws (also because of Ctrl-C), a hold is sent to the joint, and the error says
/// whether it arrived.
void run_guarded(Client& client, const std::string& joint, const std::function<void()>& motion);

/// A joint that a program moves, setpoint by setpoint.
class GuardedJoint {
 public:
  /// `purpose`: of the motion, in words, after "did not".
  GuardedJoint(Client& client, const std::string& joint, std::string purpose);

  /// A setpoint was accepted: what states tell of a load from now on, old ones aside, is this motion's.
  void accepted() { old_states_ = Deadline(kOldStates_s); }

  /// Throws ClientError unless the daemon is the same, with a state within the last half second. The joint must be enabled,
  /// without a fault and not yielding to a load, and no order of this client refused.
  void require_undisturbed();

 private:
  [[noreturn]] void fail(ExitStatus status, const std::string& why) const;
  void check_yield() const;
  void wait_for_news();

  Client& client_;
  std::string joint_;
  std::string purpose_;
  const JointView& view_;
  std::int64_t session_id_;
  std::optional<Deadline> old_states_;  ///< nothing: no setpoint was accepted yet
};

}  // namespace strainwave
