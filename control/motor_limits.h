// What motor, supply and friction leave for motion. Joint side, SI. Real-time safe. Source:
// data/rhs17_datasheet.csv.
#pragma once

#include "control/joint_model.h"
#include "control/reference_shaper.h"

namespace strainwave {

/// The motor's limits as a line over speed: |Tm| <= min(peak, stall - slope * velocity along the torque).
/// Infinite where unknown.
struct MotorLimits {
  double peak_torque_Nm = 0.0;            ///< > 0
  double stall_torque_Nm = 0.0;           ///< Kt V / R > 0
  double torque_per_speed_Nms_rad = 0.0;  ///< Kt Ke / R >= 0, Ke in V.s/rad

  /// Largest torque, >= 0, along a motion with `velocity_rad_s` (< 0: against it, where back-EMF helps).
  double available_Nm(double velocity_rad_s) const noexcept;
  /// `torque_Nm` as far as it is available at `velocity_rad_s`.
  double limit_Nm(double torque_Nm, double velocity_rad_s) const noexcept;
};

/// Acceleration and deceleration that `torque_limit_Nm` and the motor leave, less the share `reserve` of the
/// torque, to a joint that moves at `speed_rad_s` >= 0 under friction and load: friction slows acceleration
/// down and helps deceleration, the load may do either and counts against both. Never more than `motion`,
/// never less than a trickle.
MotionLimits reachable_limits(const MotionLimits& motion, const MotorLimits& motor, const JointModel& model,
                              const JointDisturbance& disturbance, double torque_limit_Nm, double reserve,
                              double speed_rad_s, double period_s) noexcept;

}  // namespace strainwave
