// SPDX-License-Identifier: BSD-3-Clause
// Reference shaping: turns targets, which may change at any moment, into a reference that the joint can
// follow. Real-time safe: allocates nothing, throws nothing, one square root per sample.
//
// Time-optimal in discrete time. With period h the acceleration a is constant over a sample, so that
//   v' = v + h a
//   x' = x + h (v + v') / 2
// hold exactly, and J a is the torque to feed forward.
//
// From speed v the joint can stop within S(v), with full deceleration D for whole samples and the remainder in the last one.
// S is the chord polygon of v^2 / 2D with nodes at v = n D h. Each sample takes the largest v' with
//   v' <= v + A h
//   v' <= V
//   S(v') + h v' / 2 <= d - h v / 2,    d: distance to the target
// which keeps the target reachable exactly, at rest, on a sample: no overshoot, no chatter around the target.
//
// A target that moves (p0 to p1 at v0 to v1 in a sample) is followed in its own frame by the same rule: x = p - x', w = v' - v1. The
// target's own acceleration reduces the limits: A where the target moves away, D where it approaches. An acceleration that helps does not
// count, since it need not last. The speed limit applies to the follower itself. On the target only the target's motion remains. Towards a
// target farther than A (0.1 s)^2 / 2 the follower uses the whole acceleration.
#pragma once

#include <limits>

#include "control/joint/motion_limits.h"
#include "control/trajectory/stream_sample.h"

namespace strainwave {

/// Allowed positions of a reference that follows a moving target.
struct PositionRange {
  double min_rad = -std::numeric_limits<double>::infinity();
  double max_rad = std::numeric_limits<double>::infinity();
};

/// The reference at a sample, with the acceleration of the period that follows; or a point of a path at an instant.
struct Reference {
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;
};

class ReferenceShaper {
 public:
  /// `period_s` > 0. At rest at 0.
  explicit ReferenceShaper(double period_s) noexcept : period_s_(period_s) {}

  /// Continues from here. The target is here; in motion it is the nearest point where the reference can stop.
  void reset(double position_rad, double velocity_rad_s) noexcept;
  /// Continues from here to the present target.
  void restart(double position_rad, double velocity_rad_s) noexcept {
    position_rad_ = position_rad;
    velocity_rad_s_ = velocity_rad_s;
  }
  /// In force from the next step. If limits shrink during a motion, the speed falls with the new deceleration.
  void set_limits(const MotionLimits& limits) noexcept { limits_ = limits; }
  void set_target(double position_rad) noexcept;
  /// Decelerates to rest and stays there until the next target.
  void stop() noexcept { stopping_ = true; }

  /// The reference for this sample; the motion then advances by one period.
  Reference step() noexcept;
  /// The same towards a moving target: joins it as soon as the limits allow, and can always stop inside `range`. Afterwards at_target() says
  /// whether the target rests and is reached.
  Reference follow(const MovingTarget& target, const PositionRange& range) noexcept;

  /// Whether the motion has ended, exactly on the target.
  bool at_target() const noexcept { return position_rad_ == target_rad_ && velocity_rad_s_ == 0.0; }
  double target_rad() const noexcept { return target_rad_; }
  /// State at the beginning of the next sample.
  double position_rad() const noexcept { return position_rad_; }
  double velocity_rad_s() const noexcept { return velocity_rad_s_; }

 private:
  double wanted_velocity_rad_s() const noexcept;
  double nearing_rad_s(const MovingTarget& target) const noexcept;
  double brake_to_rest(double velocity_rad_s) const noexcept;
  double largest_stoppable_velocity(double distance_rad, double deceleration_rad_s2) const noexcept;
  double possible_velocity_rad_s(double wanted_rad_s, const PositionRange& range) const noexcept;
  Reference advance_to(double velocity_rad_s) noexcept;

  double period_s_;
  MotionLimits limits_;
  double position_rad_ = 0.0;
  double velocity_rad_s_ = 0.0;
  double target_rad_ = 0.0;
  bool stopping_ = false;
};

}  // namespace strainwave
