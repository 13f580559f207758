// SPDX-License-Identifier: BSD-3-Clause
// What the motor must do so that the link arrives and nothing swings: turns a planned motion, accelerations in steps, into one of the link,
// and that into position and torque of the motor. Real-time safe, step() included; the constructor is not: it solves
// for a regulator. Joint side, SI.
//
// The planned motion passes through two moving means (control/trajectory/moving_mean.h) that together last tau. The link's jerk is then
// bounded and continuous, and the link's position is a flat output of the joint:
//   ts  = Jl thl'' + gravity(thl)                            the torque that the gear transmits
//   thm = thl + wind-up(ts - D wind-up'),    wind-up' = C (ts' - D C ts''),    C: compliance
//   Tm  = Jm thm'' + Jl thl'' + gravity(thl)
//
// Held over whole periods, and through slopes that change, that torque does not quite make that motion: some tens of microradians, as
// much as a joint at rest may be off. A model of the joint (control/joint/link_model.h) therefore makes the motion along with it, regulated towards
// it without delay or noise, within the torque that there is. The model's torque is the plan, and its motor is the reference.
//
// tau: half-way through a step A of the acceleration the wind-up needs Jm Jl / K * 4 (Jm + Jl) A / tau^2 / (Jm + Jl), and half of the step
// is there. Both add up to the step at
//   tau = sqrt(8) / w,   w^2 = K (1/Jm + 1/Jl)
// which is 0.45 periods of the free swing. A shorter tau needs more torque than the planned motion; a longer one takes longer.
// A jerk limit j requires tau >= 4 A / j: two means of tau / 2 keep |jerk| <= 2 A / (tau / 2).
//
// A rigid joint is the same without wind-up: the jerk limit alone sets tau, and the model is exact.
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
  /// A motor that is nearer to its place than this is there: half a count.
  double tolerance_rad = 1e-5;
  MotionLimits motion;                      ///< of what is planned
  std::optional<double> jerk_limit_rad_s3;  ///< > 0
  bool gives_way = true;                    ///< studies alone: false (control/mechanism.h)
};

/// What the motor can give over a period, friction and what else the plan does not know already taken off.
struct TorqueRange {
  double min_Nm = 0.0;
  double max_Nm = 0.0;
};

/// One period.
struct MotorPlan {
  // Where motor and link should be read now:
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;  ///< mean over the last period
  double link_position_rad = 0.0;
  // Of the period over which the torque of now will act:
  double torque_Nm = 0.0;                           ///< of motor, link and gravity, without friction
  std::array<double, 3> acting_velocities_rad_s{};  ///< the motor's at its begin, middle and end
  double acting_acceleration_rad_s2 = 0.0;          ///< mean of the motor's
  double acting_end_position_rad = 0.0;             ///< the motor's at its end
  double wanted_acceleration_rad_s2 = 0.0;          ///< mean of the link's
};

/// The wind-up as a smooth function of the torque: the first slope's compliance at zero, the last one's far out, and there the
/// same angle. The planned torque has no jumps where the catalogue's slopes change.
class SmoothWindUp {
 public:
  explicit SmoothWindUp(const TorsionSpring& spring) noexcept;
  double angle_rad(double torque_Nm) const noexcept;
  double compliance_rad_Nm(double torque_Nm) const noexcept;

 private:
  double far_rad_Nm_;    ///< compliance
  double extra_rad_Nm_;  ///< at zero torque, beyond that
  double width_Nm_;
};

class MotorPlanner {
 public:
  /// Not real-time safe.
  explicit MotorPlanner(const MotorPlannerConfig& config) noexcept;

  /// `motion` with accelerations under which the means are long enough for the jerk limit: at most jerk * longest tau / 4.
  static MotionLimits possible_limits(const MotorPlannerConfig& config) noexcept;

  /// A rigid joint's inertia, > 0.
  void set_rigid_inertia(double inertia_kgm2) noexcept { config_.joint.motor_inertia_kgm2 = inertia_kgm2; }

  /// The motor is there, and moves as the link does. Where the planned motion, which is ahead, must go on from.
  double reset(double motor_position_rad, double velocity_rad_s = 0.0) noexcept;
  /// The planned motion's next sample, its acceleration that of the period that follows. A motion that needs more than `possible`, near
  /// the supply's top speed, gets it in the plan, up to the torque limit less `taken_Nm`.
  MotorPlan step(const Reference& planned, const TorqueRange& possible, double taken_Nm) noexcept;

  /// Whether anything is still to be done: the last plan, or what of it has not acted yet.
  bool moves() const noexcept { return rest_periods_ <= config_.delay_periods; }
  /// For how long nothing has been to be done; of a plan that has begun at rest, for long.
  double rests_for_s() const noexcept { return (rest_periods_ - config_.delay_periods) * config_.period_s; }
  /// The plan's motor and link so many periods before now, 0..kMaxControlDelay.
  LinkState before(int periods) const noexcept {
    return states_[static_cast<std::size_t>(config_.delay_periods) + static_cast<std::size_t>(periods)];
  }
  /// Whether the plan of this period had less torque than it asked for.
  bool exhausted() const noexcept { return exhausted_; }
  /// Where the motor rests while the link does so at `link_position_rad`.
  double motor_rest_rad(double link_position_rad) const noexcept {
    return link_position_rad + config_.joint.spring.angle_rad(config_.joint.gravity.at(link_position_rad));
  }
  /// tau: by how much the link's motion lasts longer than the planned one.
  double spread_s() const noexcept { return spread_periods_ * config_.period_s; }

 private:
  bool rigid() const noexcept { return config_.joint.rigid(); }
  /// `snap_rad_s4`: of the period that ends there.
  LinkState flat(const MotionPoint& link, double snap_rad_s4) const noexcept;
  void follow(double wanted_Nm, const LinkState& wanted_end, const TorqueRange& possible,
              double taken_Nm) noexcept;
  void settle() noexcept;
  MotorPlan plan() noexcept;

  MotorPlannerConfig config_;
  SmoothWindUp wind_up_;
  LinkGains gains_;
  int spread_periods_;
  MovingMean first_;
  MovingMean second_;
  LinkState wanted_;          ///< at the sample to come
  double jerk_rad_s3_ = 0.0;  ///< of the link's motion, there
  LinkState next_;            ///< the model, there
  /// The model's, newest first: of now, of the last period ...; as far back as delay and late readings together.
  std::array<LinkState, 2 * kMaxControlDelay + 2> states_{};
  double torque_Nm_ = 0.0;              ///< of this period
  double middle_velocity_rad_s_ = 0.0;  ///< the model's motor, half-way through it
  bool exhausted_ = false;              ///< motion and regulator asked for more torque than there was
  bool regulates_ = false;              ///< the regulator asked for more than the motion
  int rest_periods_ = 0;                ///< since when the plan has rested
};

}  // namespace strainwave
