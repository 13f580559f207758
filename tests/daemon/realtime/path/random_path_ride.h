// SPDX-License-Identifier: BSD-3-Clause
// A drawn path on simulated joints: in by the daemon's own door as messages, through their loops, and what was seen of it. Virtual time.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "daemon/admission/admission.h"
#include "tests/daemon/realtime/path/random_paths.h"
#include "tests/support/joint_bench.h"

namespace strainwave::testing {

/// The largest of what it is told, with the joint, the path's time and the path's velocity there.
struct Farthest {
  double value = 0.0;
  std::size_t joint = 0;
  double time_s = 0.0;
  double velocity_rad_s = 0.0;
  void see(double seen, const Farthest& where) {
    if (seen > value) *this = {seen, where.joint, where.time_s, where.velocity_rad_s};
  }
  std::string text() const;
};

/// What one joint did, in cycles since the order to start.
struct Journey {
  int begins = 0;        ///< its first in mode tracking
  int first_motion = 0;  ///< the first in which its setpoint moves
  int ends = 0;          ///< the last in which it is on the path, by its state
};

/// What was seen of all joints together.
struct RideRecord {
  std::vector<Journey> journeys;
  // While the path's time goes on: where that rests a joint may correct its place.
  Farthest setpoint_off_rad;  ///< from the path at the time that the state says
  Farthest speed_rad_s;       ///< of the setpoint; so the next two
  Farthest acceleration_rad_s2;
  Farthest jerk_rad_s3;
  // Always.
  Farthest off_rad;           ///< the joint itself, its link on a spring, from the path then
  Farthest time_off_s;        ///< of the path's time in a state from the clock, but for pauses
  Farthest time_apart_s;      ///< ... from that of the first joint in the same cycle
  Farthest path_speed_rad_s;  ///< of the path, at its full rate
  Farthest torque_Nm;         ///< that the drive was told
  Farthest left_rad;          ///< from the path's end, half a second after it
  int notices = 0;            ///< all that were seen
  int rested = 0;             ///< cycles in which its time rested, on the path
  int said_paused = 0;        ///< cycles in which all joints said so
  Fault fault = Fault::kNone;
  bool arrived = false;
};

/// A pause at a time of the path, and for how long.
struct Pause {
  double at_s = 0.0;
  double for_s = 0.0;
};

class RandomPathRide {
 public:
  /// Enabled joints that hold at 0.
  RandomPathRide(const std::vector<BenchJoint>& joints, const GainTable& table);

  /// Hands a part to the daemon's door, and what passes to its joint; why it was refused, or nothing.
  std::string offer(std::size_t joint, const DrawnPart& part);
  /// The joints' loops are told to start what they have.
  Reason start() { return bench_.order(0, OrderKind::kResumePath); }
  /// Half a second in which nothing should move: the farthest that a setpoint or a joint went.
  double moves_rad();
  /// Follows `path`, which was offered, to its end.
  RideRecord ride(const DrawnPath& path, const std::optional<Pause>& pause);

 private:
  void look(const DrawnPath& path, int cycle, bool full_rate, RideRecord& record);

  std::vector<BenchJoint> configs_;
  JointBench bench_;
  Admission admission_;
  std::int64_t sequence_ = 0;
  struct Last {
    double path_time_s = 0.0;
    double setpoint_rad = 0.0;
    double velocity_rad_s = 0.0;
    double acceleration_rad_s2 = 0.0;
  };
  std::vector<Last> last_;
};

}  // namespace strainwave::testing
