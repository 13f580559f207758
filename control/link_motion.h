// What the motor must do so that the link behind the gear's spring arrives, and nothing swings: turns the planned motion of a
// rigid joint into one of the link, and that into the motor's position and torque. Real-time safe, step() included. Joint side, SI.
//
// The planned motion, accelerations in steps, passes through two moving means (control/moving_mean.h) that together last tau. The
// link's jerk is then continuous, and the link's position is a flat output of the joint:
//   ts  = Jl thl'' + load                                    the torque that the gear transmits
//   thm = thl + wind-up(ts - D wind-up')
//   Tm  = Jm thm'' + Jl thl'' + friction + load
// Torque over a period is the change of momentum over it, so that what acts in steps moves the joint as far as what is planned.
//
// tau: half-way through a step A of the acceleration the wind-up takes Jm Jl / K * 4 (Jm + Jl) A / tau^2 / (Jm + Jl) besides half of
// the step; both together are the step itself at
//   tau = sqrt(8) / w,   w^2 = K (1/Jm + 1/Jl)
// A shorter tau asks for more torque than the planned motion does, a longer one only takes longer. It is 0.45 periods of the free
// swing; a zero-vibration shaper takes 0.5, a box without residual vibration 1.
#pragma once

#include <array>

#include "control/moving_mean.h"
#include "control/reference_shaper.h"
#include "control/torsion_spring.h"

namespace strainwave {

/// The largest delay of LinkMotion::step(), in periods.
inline constexpr int kMaxLinkDelay = 8;

struct LinkMotionConfig {
  double period_s = 0.001;          ///< > 0
  double motor_inertia_kgm2 = 0.0;  ///< > 0
  double link_inertia_kgm2 = 0.0;   ///< > 0
  TorsionSpring spring;
  double damping_Nms_rad = 0.0;  ///< of the wind-up's speed, >= 0
  double torque_limit_Nm = 0.0;  ///< > 0, of the motor
  int delay_periods = 0;         ///< between a torque's computation and its effect, 0..kMaxLinkDelay
};

/// One period.
struct MotorPlan {
  /// Where the motor should be read now, and its mean velocity over the last period.
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double link_position_rad = 0.0;
  // Of the period over which the torque of now will act:
  double inertia_torque_Nm = 0.0;           ///< of motor and link, without friction and load
  double acting_velocity_rad_s = 0.0;       ///< mean of the motor's
  double acting_acceleration_rad_s2 = 0.0;  ///< mean of the motor's
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

class LinkMotion {
 public:
  explicit LinkMotion(const LinkMotionConfig& config) noexcept;

  /// Whether the spring is stiff enough for the joint's period and slow enough for its memory: tau within the moving means.
  static bool possible(const LinkMotionConfig& config) noexcept;

  /// Link and motor are there and move alike. Where the planned motion, which is ahead, must go on from.
  double reset(double position_rad, double velocity_rad_s = 0.0) noexcept;
  /// The planned motion's next sample, its acceleration that of the period that follows.
  MotorPlan step(const Reference& planned) noexcept;

  /// Whether anything is still to be done: the last plan, or what of it has not acted yet.
  bool moves() const noexcept { return rest_periods_ <= config_.delay_periods; }
  /// By how much the link's motion lasts longer than the planned one.
  double spread_s() const noexcept { return spread_periods_ * config_.period_s; }

 private:
  struct State {
    double link_position_rad = 0.0, link_velocity_rad_s = 0.0;
    double motor_position_rad = 0.0, motor_velocity_rad_s = 0.0;
  };
  State flat(const MotionPoint& link) const noexcept;

  LinkMotionConfig config_;
  SmoothWindUp wind_up_;
  int spread_periods_;
  MovingMean first_;
  MovingMean second_;
  State next_;                                     ///< at the sample to come
  std::array<State, kMaxLinkDelay + 2> states_{};  ///< newest first: of now, of the last period ...
  int rest_periods_ = 0;                           ///< since when the plan has rested
};

}  // namespace strainwave
