// What the motor must do so that the link behind the gear's spring arrives, and nothing swings: turns the planned motion of a
// rigid joint into one of the link, and that into the motor's position and torque. Real-time safe, step() included; the constructor
// is not: it solves for a regulator. Joint side, SI.
//
// The planned motion, accelerations in steps, passes through two moving means (control/moving_mean.h) that together last tau. The
// link's jerk is then continuous, and the link's position is a flat output of the joint:
//   ts  = Jl thl'' + load(thl)                               the torque that the gear transmits
//   thm = thl + wind-up(ts - D wind-up'),    wind-up' = C (ts' - D C ts''),    C: compliance
//   Tm  = Jm thm'' + Jl thl'' + load(thl)
//
// Held over whole periods, and through slopes that change, that torque does not quite make that motion: some tens of microradians, as
// much as a joint at rest may be off. So a model of the joint (control/link_model.h) makes the motion along with it, regulated
// towards it without delay or noise, within the torque that there is: by where each period would end without that. What the model does, a joint that is as it was told does
// as well: its torque is the plan, and where its motor is, is the reference.
//
// tau: half-way through a step A of the acceleration the wind-up takes Jm Jl / K * 4 (Jm + Jl) A / tau^2 / (Jm + Jl) besides half of
// the step; both together are the step itself at
//   tau = sqrt(8) / w,   w^2 = K (1/Jm + 1/Jl)
// A shorter tau asks for more torque than the planned motion does, a longer one only takes longer. It is 0.45 periods of the free
// swing; a zero-vibration shaper takes 0.5, a box without residual vibration 1.
#pragma once

#include <array>

#include "control/link_model.h"
#include "control/moving_mean.h"
#include "control/reference_shaper.h"

namespace strainwave {

/// The largest delay of LinkMotion::step(), in periods.
inline constexpr int kMaxLinkDelay = 8;

struct LinkMotionConfig {
  double period_s = 0.001;  ///< > 0
  LinkModel joint;
  double torque_limit_Nm = 0.0;  ///< > 0, of the motor
  int delay_periods = 0;         ///< between a torque's computation and its effect, 0..kMaxLinkDelay
  /// A motor that is nearer to its place than this is there: half a count.
  double tolerance_rad = 1e-5;
};

/// What the motor can give over a period, friction and what else the plan does not know already taken off.
struct TorqueRange {
  double min_Nm = 0.0;
  double max_Nm = 0.0;
};

/// One period.
struct MotorPlan {
  /// Where the motor should be read now, and its mean velocity over the last period.
  double position_rad = 0.0;
  double velocity_rad_s = 0.0;
  double link_position_rad = 0.0;
  // Of the period over which the torque of now will act:
  double torque_Nm = 0.0;                           ///< of motor, link and gravity, without friction
  std::array<double, 3> acting_velocities_rad_s{};  ///< the motor's at its begin, middle and end
  double acting_acceleration_rad_s2 = 0.0;          ///< mean of the motor's
  double wanted_acceleration_rad_s2 = 0.0;  ///< mean of the link's, by the motion that it follows alone
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
  /// Not real-time safe.
  explicit LinkMotion(const LinkMotionConfig& config) noexcept;

  /// Whether the spring is stiff enough for the joint's period and slow enough for its memory: tau within the moving means.
  static bool possible(const LinkMotionConfig& config) noexcept;

  /// The motor is there, and moves as the link does. Where the planned motion, which is ahead, must go on from.
  double reset(double motor_position_rad, double velocity_rad_s = 0.0) noexcept;
  /// The planned motion's next sample, its acceleration that of the period that follows. Where the motion asks for more than
  /// `possible` leaves, as at a speed that the supply barely reaches, the plan does so, too: up to the torque limit, of which
  /// `taken_Nm` is gone already.
  MotorPlan step(const Reference& planned, const TorqueRange& possible, double taken_Nm) noexcept;

  /// Whether anything is still to be done: the last plan, or what of it has not acted yet.
  bool moves() const noexcept { return rest_periods_ <= config_.delay_periods; }
  /// Where the motor rests while the link does so at `link_position_rad`.
  double motor_rest_rad(double link_position_rad) const noexcept {
    return link_position_rad + config_.joint.spring.angle_rad(config_.joint.gravity.at(link_position_rad));
  }
  /// By how much the link's motion lasts longer than the planned one.
  double spread_s() const noexcept { return spread_periods_ * config_.period_s; }

 private:
  /// `snap_rad_s4`: of the period that ends there.
  LinkState flat(const MotionPoint& link, double snap_rad_s4) const noexcept;
  void follow(double wanted_Nm, const LinkState& wanted_end, const TorqueRange& possible,
              double taken_Nm) noexcept;
  void count_swings() noexcept;
  void yield(bool ended) noexcept;
  void settle() noexcept;
  MotorPlan plan() noexcept;

  LinkMotionConfig config_;
  SmoothWindUp wind_up_;
  LinkGains gains_;
  int spread_periods_;
  MovingMean first_;
  MovingMean second_;
  double lost_rad_;
  LinkState wanted_;          ///< at the sample to come
  double jerk_rad_s3_ = 0.0;  ///< of the link's motion, there
  LinkState next_;            ///< the model, there
  std::array<LinkState, kMaxLinkDelay + 2>
      states_{};                        ///< the model's, newest first: of now, of the last period ...
  double torque_Nm_ = 0.0;              ///< of this period
  double middle_velocity_rad_s_ = 0.0;  ///< the model's motor, half-way through it
  int exhausted_ = 0;     ///< the regulator asked for more than there was: on which side, -1 or 1; else 0
  int side_ = 0;          ///< where it did last
  int swings_ = 0;        ///< how often in a row it was on the other side than before
  int calm_periods_ = 0;  ///< since it asked for more than there was
  int rest_periods_ = 0;  ///< since when the plan has rested
};

}  // namespace strainwave
