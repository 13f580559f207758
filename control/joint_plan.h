// SPDX-License-Identifier: BSD-3-Clause
// What one joint is to do: trajectory of the link, plan of the motor, and the small motions of the last counts. The torque that the plan needs
// is here, what the feedback adds is control/joint_controller.h's. Real-time safe but for the constructor. Joint side, SI.
//
//   trajectory   p, v, a of the link at the instant at which the torque of now acts      (control/trajectory/trajectory.h)
//   plan         thm*, wm*, T* of the motor, by the gear's spring                        (control/trajectory/motor_plan.h)
//   torque       T* + (1 + c) F(wm*) + load + gravity at rest
//   c            friction beside the table's that corrections have shown                 (control/rest_corrections.h)
//
// A torque that is spent slows the motion down: the accelerations fall while the torque is limited.
#pragma once

#include <cstdint>

#include "control/joint/joint_measurement.h"
#include "control/joint/joint_model.h"
#include "control/joint_controller_config.h"
#include "control/rest_corrections.h"
#include "control/trajectory/motor_plan.h"
#include "control/trajectory/trajectory.h"

namespace strainwave {

/// What the plan reckons with: the joint as it is now.
struct PlannedJoint {
  JointModel model;              ///< inertia with the stream's load, and friction at the present temperature
  double load_Nm = 0.0;          ///< learned; gravity and the stream's load come on top
  double torque_limit_Nm = 0.0;  ///< > 0, of table and configuration
  double driving_Nm = 0.0;       ///< at most that, with which a motion speeds up
};

class JointPlan {
 public:
  /// Not real-time safe: solves for a regulator where there is a link.
  explicit JointPlan(const JointControllerConfig& config) noexcept;
  /// A rigid joint's inertia, > 0, of its table.
  void set_rigid_inertia(double inertia_kgm2) noexcept { planner_.set_rigid_inertia(inertia_kgm2); }

  /// Comes to rest from here, where the encoder reads `reading_rad`, and stays.
  void start(double reading_rad, double velocity_rad_s) noexcept;
  /// The orders of control/joint_controller.h.
  void set_target(double position_rad, double speed_limit_rad_s) noexcept;
  SampleFate follow(const StreamSample& sample, bool begins, double speed_limit_rad_s,
                    const PositionRange& range) noexcept;
  void follow_path(double position_rad, double velocity_rad_s, std::int64_t in_periods,
                   const PositionRange& range) noexcept;
  void stop() noexcept { trajectory_.stop(); }

  /// So many periods, >= 1, after the last advance() comes the next.
  void begin_period(std::int64_t elapsed_periods) noexcept { trajectory_.begin_period(elapsed_periods); }
  /// Goes on to what was ordered from where the encoder reads `reading_rad`.
  void go_on_from(double reading_rad, double velocity_rad_s) noexcept;
  /// One period on.
  void advance(const PlannedJoint& joint) noexcept;
  /// A stream is over: the torque that it had named, once. It is what the joint carries from now on, as far as is known.
  double take_load_Nm() noexcept;
  /// The torque was limited for so long: while a move speeds up, its accelerations fall.
  void slow_down(double elapsed_s) noexcept;
  /// One period of rest, `off_rad` short of its place, the reading `reading_rad` the same for `still_periods`. True: a correction begins.
  bool correct(double off_rad, double reading_rad, int still_periods) noexcept;

  const MotorPlan& now() const noexcept { return plan_; }
  /// Where the encoder should be read now.
  double place_rad() const noexcept;
  /// Where the encoder should have been read so many periods before now.
  double place_before_rad(int periods) const noexcept;
  /// What the encoder reads once the joint rests at its target: a motor's is beside it by the wind-up under gravity.
  double rest_position_rad() const noexcept;
  bool moves() const noexcept { return planner_.moves() || !trajectory_.rests(); }
  /// The plan is so much ahead of the joint: the delay, and half of what the link's motion lasts longer. A sample that comes later than
  /// this before its instant is late.
  double lead_s() const noexcept;
  /// What the motion needs, friction and loads included; at rest what holds.
  double torque_Nm(const PlannedJoint& joint) const noexcept;
  const Trajectory& trajectory() const noexcept { return trajectory_; }
  const MotorPlanner& planner() const noexcept { return planner_; }
  const RestCorrections& corrections() const noexcept { return corrections_; }

 private:
  void begin_order(double speed_limit_rad_s) noexcept;
  double begin_plan(double reading_rad, double velocity_rad_s, double torque_Nm) noexcept;
  MotionLimits present_limits(const PlannedJoint& joint) const noexcept;

  JointControllerConfig config_;
  Trajectory trajectory_;
  MotorPlanner planner_;
  RestCorrections corrections_;
  MotorPlan plan_;
  double change_Nm_ = 0.0;  ///< of the plan's torque, in this period
  MotionLimits motion_;     ///< the configuration's, and this order's speed
  double pace_ = 1.0;       ///< of accelerations, in (0, 1]
  bool speeds_up_ = false;  ///< the trajectory, in this period
};

/// What the encoder cannot tell, > 0: one count, or of exact sensing a bound.
double count_of(const JointControllerConfig& config) noexcept;

}  // namespace strainwave
