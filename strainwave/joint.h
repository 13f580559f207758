// SPDX-License-Identifier: BSD-3-Clause
// A joint of a Strainwave daemon, for users' programs. Orders are signed, acknowledged and repeated; there are streams of setpoints, and
// states with names and units. docs/client.md has programs of ten lines. Not real-time: every call may wait, at most `timeout_s` for one
// answer.
//
//     strainwave::Joint joint{"elbow", {.key = "~/.strainwave-key"}};
//     joint.enable();
//     joint.move(0.5);
//
// Every failure throws a ClientError (client_error.h). Calls run one at a time: a call from another thread waits for the one before. A
// second Joint of the same name is independent but has the same owner. With it, another thread can stop a motion during its move().
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "strainwave/client_error.h"
#include "strainwave/move_order.h"
#include "strainwave/state.h"
#include "strainwave/stream.h"

namespace strainwave {

struct JointOptions {
  /// File of the secret key (strainwavectl keygen); "~/" is the home folder. Without a value, STRAINWAVE_KEY names the file. With an empty
  /// name, or without both, orders are unsigned.
  std::optional<std::filesystem::path> key = {};
  std::string prefix = "SW";  ///< the daemon's prefix
  std::string lcm_url = {};   ///< empty: that of LCM_DEFAULT_URL, else LCM's usual one on this machine
  double timeout_s = 2.0;     ///< for each single wait: for a state, an answer, a change of mode; 0.1 to 3600
};

class JointLink;

class Joint {
 public:
  /// `name`: the joint's name in the daemon's configuration. Throws InvalidInput, NoAnswer (LCM is not available).
  explicit Joint(const std::string& name, const JointOptions& options = {});
  ~Joint();
  Joint(Joint&&) noexcept;
  Joint& operator=(Joint&&) noexcept;
  Joint(const Joint&) = delete;
  Joint& operator=(const Joint&) = delete;

  const std::string& name() const noexcept;

  /// Returns the latest state; waits for the first. Throws NoAnswer, also when the joint has been silent for `timeout_s`.
  State state();

  /// Returns the limits, which are constant while the daemon runs. Waits for the first message, which may take a second.
  Limits limits();

  /// Calls `visit` for every state that comes, in order, for `duration_s`. A caller that is too slow sees gaps in `cycle`.
  void states(double duration_s, const std::function<void(const State&)>& visit);

  /// Switches the drive on; returns once the joint holds. If the drive is on already, nothing is sent, and it is no error.
  void enable();
  /// Stops the joint and switches the drive off; returns once it is off. Needs no key, and is sent without waiting for a state.
  void disable();
  /// Stops the joint; returns once it holds where it came to rest. Needs no key.
  void hold();
  /// Clears a latched fault; the joint is off then. Does nothing without a fault.
  void clear_fault();
  /// Finds the home position; returns once the joint holds there.
  void home();
  /// Makes this user the owner of the joint, even if another client owns it. Needs the role engineer.
  void take_over();
  /// Gives up the ownership of the joint before the lease ends. The joint then has no owner.
  void release();
  /// Forgets the learned friction and load: the joint uses its table's friction. It must hold or be off.
  void reset_learning();
  /// Keeps the learned values in use but unchanged, until resume_learning() or a restart of the daemon.
  void freeze_learning();
  /// The joint learns again.
  void resume_learning();

  /// Returns once the joint is within `tolerance_rad` (1 mrad) of the position and stays there. An exception does not end the motion:
  /// hold() does.
  Arrival move(double position_rad) { return move(MoveOrder{.position_rad = position_rad}); }
  Arrival move(const MoveOrder& order);
  /// Starts the same motion, but returns at once.
  void start_move(const MoveOrder& order);

  /// A stream of setpoints. Nothing moves before its first put().
  Stream stream(const StreamOptions& options = {});

 private:
  friend class Path;
  std::shared_ptr<JointLink> link_;
};

}  // namespace strainwave
