// SPDX-License-Identifier: BSD-3-Clause
// The plan of one joint: trajectory of the link, plan of the motor, and small corrections at rest. It gives the feed-forward torque;
// control/joint_controller.h adds the feedback. Real-time safe except for the constructor. Joint side, SI.
//
//   trajectory   p, v, a of the link at the instant when the present torque acts          (control/trajectory/trajectory.h)
//   plan         thm*, wm*, T* of the motor, by the gear's spring                        (control/trajectory/motor_plan.h)
//   torque       T* + (1 + c) F(wm*) + load; at rest gravity + load
//   c            friction beyond the table's that corrections have shown                 (control/rest_corrections.h)
//
// While a motion speeds up with a saturated torque, the plan lowers its accelerations.
#pragma once

#include <cstdint>

#include "control/joint/joint_measurement.h"
#include "control/joint/joint_model.h"
#include "control/joint_controller_config.h"
#include "control/rest_corrections.h"
#include "control/trajectory/motor_plan.h"
#include "control/trajectory/trajectory.h"

namespace strainwave {

/// The joint in its present state, as input of the plan.
struct PlannedJoint {
  JointModel model;              ///< inertia with the stream's load, and friction at the present temperature
  double load_Nm = 0.0;          ///< learned; gravity and the stream's load come on top
  double torque_limit_Nm = 0.0;  ///< > 0, of table and configuration
  double driving_Nm = 0.0;       ///< torque limit while speeding up, at most torque_limit_Nm
};

class JointPlan {
 public:
  /// Not real-time safe: solves for a regulator where there is a link.
  explicit JointPlan(const JointControllerConfig& config) noexcept;
  /// Sets a rigid joint's inertia, > 0, from its table.
  void set_rigid_inertia(double inertia_kgm2) noexcept { planner_.set_rigid_inertia(inertia_kgm2); }

  /// Starts where the encoder reads `reading_rad`, decelerates to rest and stays.
  void start(double reading_rad, double velocity_rad_s) noexcept;
  /// Orders as in control/joint_controller.h.
  void set_target(double position_rad, double speed_limit_rad_s) noexcept;
  SampleFate follow(const StreamSample& sample, bool begins, double speed_limit_rad_s,
                    const PositionRange& range) noexcept;
  void follow_path(double position_rad, double velocity_rad_s, std::int64_t in_periods,
                   const PositionRange& range) noexcept;
  void stop() noexcept { trajectory_.stop(); }

  /// The next advance() comes `elapsed_periods` >= 1 after the last one.
  void begin_period(std::int64_t elapsed_periods) noexcept { trajectory_.begin_period(elapsed_periods); }
  /// Continues to the ordered target from where the encoder reads `reading_rad`.
  void go_on_from(double reading_rad, double velocity_rad_s) noexcept;
  /// Advances by one period.
  void advance(const PlannedJoint& joint) noexcept;
  /// Returns the torque that a stream named before it ended, once. The controller assumes from then on that the joint carries this load.
  double take_load_Nm() noexcept;
  /// The torque was saturated for `elapsed_s`: lowers the accelerations of a move that speeds up.
  void slow_down(double elapsed_s) noexcept;
  /// One period at rest, `off_rad` short of the target, with a constant reading for `still_periods`. Returns true if a correction begins.
  bool correct(double off_rad, double reading_rad, int still_periods) noexcept;

  const MotorPlan& now() const noexcept { return plan_; }
  /// Position that the encoder should read now.
  double place_rad() const noexcept;
  /// Position that the encoder should have read `periods` ago.
  double place_before_rad(int periods) const noexcept;
  /// Encoder reading of a joint at rest on its target. A motor encoder differs from the target by gravity's wind-up.
  double rest_position_rad() const noexcept;
  bool moves() const noexcept { return planner_.moves() || !trajectory_.rests(); }
  /// Lead of the plan over the joint: the delay, and half of the time that smoothing adds to the link's motion. A sample must arrive at least
  /// this long before its instant; otherwise it is late.
  double lead_s() const noexcept;
  /// Torque that the motion needs, with friction and loads; at rest the holding torque.
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
  double change_Nm_ = 0.0;  ///< change of the plan's torque in this period
  MotionLimits motion_;     ///< configured limits with this order's speed limit
  double pace_ = 1.0;       ///< factor on the accelerations, in (0, 1]
  bool speeds_up_ = false;  ///< whether the trajectory speeds up in this period
};

/// Resolution of the encoder, > 0: one count, but at least a bound for exact sensing.
double count_of(const JointControllerConfig& config) noexcept;

}  // namespace strainwave
