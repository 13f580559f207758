// SPDX-License-Identifier: BSD-3-Clause
// A joint of a Strainwave daemon, for users' programs. Orders are signed, acknowledged and repeated; there are streams of setpoints, and
// states with names and units. docs/client.md has programs of ten lines. Not real-time: every call may wait, at most `timeout_s` for one
// answer.
//
//     strainwave::Joint joint{"elbow", {.key = "~/.strainwave-key"}};
//     joint.enable();
//     joint.move(0.5);
//
// All that fails throws a ClientError (client_error.h). One call at a time: a call from another thread waits for the one before. A second
// Joint of the same name is independent of the first, and the same owner: that is how another thread stops a motion that is waited for.
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
  /// File of the secret key (strainwavectl keygen), "~/" is the home folder; nothing: what STRAINWAVE_KEY names. With an empty name, or
  /// neither, orders go out unsigned.
  std::optional<std::filesystem::path> key = {};
  std::string prefix = "SW";  ///< the daemon's
  std::string lcm_url = {};   ///< empty: what LCM_DEFAULT_URL says, or LCM's usual one on this machine
  double timeout_s =
      2.0;  ///< of every single wait: for a state, for an answer, for a change of mode; 0.1 to 3600
};

class JointLink;

class Joint {
 public:
  /// `name`: the joint's in the daemon's configuration. Throws InvalidInput, NoAnswer (LCM is not available).
  explicit Joint(const std::string& name, const JointOptions& options = {});
  ~Joint();
  Joint(Joint&&) noexcept;
  Joint& operator=(Joint&&) noexcept;
  Joint(const Joint&) = delete;
  Joint& operator=(const Joint&) = delete;

  const std::string& name() const noexcept;

  /// The latest; waits for the first. Throws NoAnswer, also when the joint has been silent for `timeout_s`.
  State state();

  /// Constant while the daemon runs; waits for the first, which may take a second.
  Limits limits();

  /// Calls `visit` for every state that comes, in order, for `duration_s`. A caller that is too slow sees gaps in `cycle`.
  void states(double duration_s, const std::function<void(const State&)>& visit);

  /// Switches the drive on; returns once the joint holds. What is so already is no error, and nothing is sent for it.
  void enable();
  /// Stops and switches the drive off; returns once it is. Needs no key, and waits for no state before it is sent.
  void disable();
  /// Stops where the joint comes to rest; returns once it holds. Needs no key, either.
  void hold();
  /// Leaves a latched fault, to off. A joint without one is left alone.
  void clear_fault();
  /// Finds the home position; returns once the joint holds there.
  void home();
  /// Makes this user the owner of the joint, also where another client owns it. Needs the role engineer.
  void take_over();
  /// Gives the joint up before its lease ends: it has no owner.
  void release();
  /// Forgets the learned friction and load: the joint takes its table's friction. It must hold or be off.
  void reset_learning();
  /// What was learned stays in use and changes no more, until resume_learning() or a restart of the daemon.
  void freeze_learning();
  /// The joint learns again.
  void resume_learning();

  /// Returns once the joint is within `tolerance_rad` (1 mrad) of the position and stays there. An exception does not end the motion:
  /// hold() does.
  Arrival move(double position_rad) { return move(MoveOrder{.position_rad = position_rad}); }
  Arrival move(const MoveOrder& order);
  /// The same, but returns at once: the joint is on its way.
  void start_move(const MoveOrder& order);

  /// A stream of setpoints. Nothing moves before its first put().
  Stream stream(const StreamOptions& options = {});

 private:
  friend class Path;
  std::shared_ptr<JointLink> link_;
};

}  // namespace strainwave
