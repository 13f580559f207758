// What JointController (control/joint_controller.h) is told of its joint, and which of its parts it uses. Plain data. Joint side, SI.
#pragma once

#include <algorithm>
#include <optional>

#include "control/encoder_side.h"
#include "control/gain_table.h"
#include "control/gravity_load.h"
#include "control/link_model.h"
#include "control/motor_limits.h"
#include "control/reference_shaper.h"

namespace strainwave {

/// One joint's configuration. Each feature can be switched off;
/// without any, the plain control law of the table is left.
struct JointControllerConfig {
  double period_s = 0.001;                 ///< > 0, the table's
  double encoder_resolution_rad = 0.0;     ///< position of one count at the joint; 0: exact
  double encoder_deviation_counts = 0.02;  ///< how evenly its edges lie, noise included, standard deviation
  /// How evenly positions are sampled, >= 0, standard deviation.
  double sampling_deviation_s = 0.0;
  /// Periods between a torque's computation and its effect, 0..kMaxControlDelay.
  int delay_periods = 0;
  /// Time constant of the drive's current loop, >= 0: the observer and the landing know by it what acts. Nothing else uses it. Where it
  /// is not given what is commanded acts at once.
  std::optional<double> current_loop_s;
  double torque_limit_Nm = 0.0;  ///< > 0; the table's limit applies as well
  double torque_limit_with(const GainTable& table) const noexcept {
    return std::min(torque_limit_Nm, table.torque_limit_Nm);
  }
  MotorLimits motor;
  MotionLimits motion;  ///< of the reference; what the joint can do limits it further
  /// Of the reference, > 0; with use_shaping. Where it is so low that kMaxMeanPeriods do not suffice, accelerations are lower, too.
  /// Without it moves that begin at rest are eased where a spring may hang on the joint that no model follows: a step of the acceleration
  /// swings it.
  std::optional<double> jerk_limit_rad_s3;
  /// How long a stream whose samples do not come goes on as it was; at least two of its intervals, at most 0.2 s.
  double stream_bridge_s = 0.05;
  /// Share of the torque that the reference leaves to the feedback, in [0, 1).
  double torque_reserve = 0.02;

  bool use_shaping = true;  ///< else targets are steps
  bool use_rest = true;     ///< at the target the torque and the integral stand still
  /// The joint has no spring between motor and load that matters: its encoder shows the one inertia that the
  /// table is for. Only then a reference that the joint has left may begin anew from where the joint is.
  bool rigid = false;
  /// Position, velocity, friction, load and inertia estimated from encoder and torque, over the delay as well, by
  /// the model of one inertia: for joints that are rigid. Else the velocity is the measured one or the difference
  /// of two readings, and load and friction are the integral's.
  bool use_observer = false;
  bool use_landing = false;  ///< the last counts by pushes; only with rigid, use_observer and use_rest
  bool use_monitor = true;   ///< without it only to study what it prevents
  /// Motions that do not swing the link; only with use_shaping, without rigid. The observer knows one inertia and is then not used.
  /// The target is the link's, and both inertias together are the joint's. Its gravity is the one below.
  std::optional<LinkModel> link;
  /// The motor's, whose motion is the model's; or the link's: no model is then followed, and the law is on its reading (link_velocity.h).
  EncoderSide encoder_side = EncoderSide::kMotor;
  /// What gravity makes of link and payload, as far as it is told; only without use_observer, which finds it by itself. Loads
  /// that are known otherwise come on top.
  GravityLoad gravity;
};

}  // namespace strainwave
