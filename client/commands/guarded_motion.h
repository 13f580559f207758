// SPDX-License-Identifier: BSD-3-Clause
// Guards a motion that a program orders setpoint by setpoint: if it ends early, the joint holds. Not real-time.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "client/protocol/client.h"
#include "client/protocol/orders.h"

namespace strainwave {

/// Runs `motion`. When it throws (also because of Ctrl-C), the function sends a hold to the joint. The error
/// then tells whether the hold arrived.
void run_guarded(Client& client, const std::string& joint, const std::function<void()>& motion);

/// A joint that a program moves, setpoint by setpoint.
class GuardedJoint {
 public:
  /// `purpose` names the motion in error messages, after "did not".
  GuardedJoint(Client& client, const std::string& joint, std::string purpose);

  /// Notes an accepted setpoint. After kOldStates_s, a reported yield to a load belongs to this motion.
  void accepted() { old_states_ = Deadline(kOldStates_s); }

  /// Throws ClientError unless the same daemon still runs and its last state is at most half a second old. The
  /// joint must be enabled, without a fault and not yielding to a load. No order of this client may be refused.
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
  std::optional<Deadline> old_states_;  ///< no value: no setpoint was accepted yet
};

}  // namespace strainwave
