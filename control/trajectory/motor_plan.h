// SPDX-License-Identifier: BSD-3-Clause
// Plans the motor so that the link arrives without swinging. Turns a planned motion, with steps of acceleration, into a motion of the link,
// and that into position and torque of the motor. Real-time safe, step() included, except for the constructor, which solves for a
// regulator. Joint side, SI.
//
// The planned motion passes through two moving means (control/trajectory/moving_mean.h) of total length tau. The link's jerk is then
// bounded and continuous, and the link's position is a flat output of the joint:
//   ts  = Jl thl'' + gravity(thl)                            the torque that the gear transmits
//   thm = thl + wind-up(ts - D wind-up'),    wind-up' = C (ts' - D C ts''),    C: compliance
//   Tm  = Jm thm'' + Jl thl'' + gravity(thl)
//
// The torque is held over whole periods, and the slopes change. It therefore misses the motion by some tens of microradians, as much as a joint
// at rest may be off. So a model of the joint (control/joint/link_model.h) follows the motion, regulated without delay or noise, within the available
// torque. The model's torque is the plan, and its motor is the reference.
//
// Choice of tau: half-way through a step A of the acceleration, half of the step of torque, (Jm + Jl) A / 2, has been made. The wind-up
// then needs Jm Jl / K * 4 (Jm + Jl) A / tau^2 / (Jm + Jl). Both add up to the whole step at
//   tau = sqrt(8) / w,   w^2 = K (1/Jm + 1/Jl)
// which is 0.45 periods of the free swing. A shorter tau needs more torque than the planned motion; a longer one takes longer. So tau is
// rounded up to whole periods.
// A jerk limit j requires tau >= 4 A / j: two means of tau / 2 keep |jerk| <= 2 A / (tau / 2).
//
// A rigid joint has no wind-up: the jerk limit alone sets tau, and the model is exact.
#pragma once

#include <array>
#include <optional>

#include "control/joint/joint_measurement.h"
#include "control/joint/link_model.h"
#include "control/trajectory/moving_mean.h"
#include "control/trajectory/reference_shaper.h"

namespace strainwave {

struct MotorPlannerConfig {
  double period_s = 0.001;  ///< > 0
  LinkModel joint;
  double torque_limit_Nm = 0.0;  ///< > 0, of the motor
  int delay_periods = 0;         ///< between a torque's computation and its effect, 0..kMaxControlDelay
  /// A motor within this distance of its target has arrived: half a count.
  double tolerance_rad = 1e-5;
  MotionLimits motion;                      ///< of the planned motion
  std::optional<double> jerk_limit_rad_s3;  ///< > 0
  bool gives_way = true;                    ///< false for studies only (control/mechanism.h)
};

/// Torque that the motor has for the plan over a period: friction and everything else that the plan does not contain is subtracted.
struct TorqueRange {
  double min_Nm = 0.0;
  double max_Nm = 0.0;
};

/// One period.
struct MotorPlan {
  // Expected readings of motor and link now:
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;  ///< mean over the last period
  double link_position_rad = 0.0;
  // For the period over which the present torque will act:
  double torque_Nm = 0.0;                           ///< for motor, link and gravity, without friction
  std::array<double, 3> acting_velocities_rad_s{};  ///< the motor's at its beginning, middle and end
  double acting_acceleration_rad_s2 = 0.0;          ///< mean of the motor's
  double acting_end_position_rad = 0.0;             ///< the motor's at its end
  double wanted_acceleration_rad_s2 = 0.0;          ///< mean of the link's
};

class MotorPlanner {
 public:
  /// Not real-time safe.
  explicit MotorPlanner(const MotorPlannerConfig& config) noexcept;

  /// `motion` with accelerations that allow the jerk limit with the longest means: at most jerk * longest tau / 4.
  static MotionLimits possible_limits(const MotorPlannerConfig& config) noexcept;

  /// Sets a rigid joint's inertia, > 0.
  void set_rigid_inertia(double inertia_kgm2) noexcept { config_.joint.motor_inertia_kgm2 = inertia_kgm2; }

  /// Starts at this motor position, motor and link in motion alike. Returns where the planned motion, which leads, must continue.
  double reset(double motor_position_rad, double velocity_rad_s = 0.0) noexcept;
  /// Takes the next sample of the planned motion, with the acceleration of the period that follows. Near the supply's top speed the motion may
  /// need more than `possible`. The plan then contains this torque, up to the torque limit less `taken_Nm`.
  MotorPlan step(const Reference& planned, const TorqueRange& possible, double taken_Nm) noexcept;

  /// Whether the plan moves, or a part of it has yet to act.
  bool moves() const noexcept { return rest_periods_ <= config_.delay_periods; }
  /// How long no part of a motion has been left to act; very long if the plan began at rest.
  double rests_for_s() const noexcept { return (rest_periods_ - config_.delay_periods) * config_.period_s; }
  /// Motor and link by the plan `periods` ago, 0..kMaxControlDelay.
  LinkState before(int periods) const noexcept {
    return states_[static_cast<std::size_t>(config_.delay_periods) + static_cast<std::size_t>(periods)];
  }
  /// Whether this period's plan needed more torque than was available.
  bool exhausted() const noexcept { return exhausted_; }
  /// Motor position at rest while the link rests at `link_position_rad`.
  double motor_rest_rad(double link_position_rad) const noexcept {
    return link_position_rad + config_.joint.spring.angle_rad(config_.joint.gravity.at(link_position_rad));
  }
  /// tau: by how much smoothing extends the link's motion.
  double spread_s() const noexcept { return spread_periods_ * config_.period_s; }

 private:
  bool rigid() const noexcept { return config_.joint.rigid(); }
  /// Motor and link for this motion of the link; `snap_rad_s4` is the mean over the period that ends there.
  LinkState flat(const MotionPoint& link, double snap_rad_s4) const noexcept;
  void follow(double wanted_Nm, const LinkState& wanted_end, const TorqueRange& possible,
              double taken_Nm) noexcept;
  void settle() noexcept;
  MotorPlan plan() noexcept;

  MotorPlannerConfig config_;
  LinkGains gains_;
  int spread_periods_;
  MovingMean first_;
  MovingMean second_;
  LinkState wanted_;          ///< by the motion, at the next sample
  double jerk_rad_s3_ = 0.0;  ///< of the link's motion then
  LinkState next_;            ///< state of the model then
  /// The model's states, newest first: now, one period ago, ...; they cover delay and late readings together.
  std::array<LinkState, 2 * kMaxControlDelay + 2> states_{};
  double torque_Nm_ = 0.0;              ///< of this period
  double middle_velocity_rad_s_ = 0.0;  ///< of the model's motor, half-way through the period
  bool exhausted_ = false;              ///< motion and regulator asked for more torque than there was
  bool regulates_ = false;              ///< the regulator asked for more torque than the motion
  int rest_periods_ = 0;                ///< for which the plan has rested
};

}  // namespace strainwave
