// The joint as the controller knows it: one inertia, friction at the present temperature with true stiction,
// and what is not known of friction, load and inertia. Used by the observer, the landing and the
// feed-forward. Real-time safe. Source: Zhao (2006), (2-1)..(2-4).
//
//   w != 0:  J dw/dt = torque - load - sign(w) (F(|w|) + friction offset)
//   w  = 0:  at rest while |torque - load| <= Fs + friction offset
//   F(w) = Fc + Fv w + (Fs - Fc) exp(-(w/ws)^2)
//
// ws is half the width of the table's "zero velocity" membership, which with the source's memberships is the
// Stribeck velocity of the catalogue.
#pragma once

#include "control/friction.h"

namespace strainwave {

/// What the model leaves open, estimated on line. Joint side.
struct JointDisturbance {
  double friction_offset_Nm = 0.0;  ///< more friction than the model says; opposes motion either way
  double load_Nm = 0.0;             ///< external torque; positive opposes positive motor torque
};

/// One period's motion and its derivatives by the velocity
/// at its start, by both disturbances and by the inertia.
struct ModelMotion {
  double displacement_rad = 0.0;
  double velocity_rad_s = 0.0;  ///< at the end
  bool moved = false;           ///< false: at rest throughout
  double displacement_by_velocity = 0.0, velocity_by_velocity = 0.0;
  double displacement_by_friction = 0.0, velocity_by_friction = 0.0;
  double displacement_by_load = 0.0, velocity_by_load = 0.0;
  double displacement_by_inertia = 0.0, velocity_by_inertia = 0.0;  ///< by the relative change of the inertia
};

struct JointModel {
  double inertia_kgm2 = 1.0;  ///< > 0
  FrictionParameters friction;
  StribeckShape stribeck;
  double friction_scale_Nm = 1.0;  ///< > 0: the table's least static friction; the unit of what is unknown

  /// F(|w|) > 0, and Fs for w -> 0.
  double friction_Nm(double velocity_rad_s) const noexcept;
  /// Mean torque against friction over a time in which the velocity changes evenly from `begin_rad_s` to `end_rad_s`: of its sign
  /// where it goes on, and of either for as long as it lasts where the joint turns round. 0 at rest.
  double friction_along_Nm(double begin_rad_s, double end_rad_s) const noexcept;
  /// Constant torque over `period_s`, from `velocity_rad_s`. A joint that stops within the period stays at
  /// rest for what is left of it, or breaks away if the torque is large enough.
  ModelMotion advance(double torque_Nm, const JointDisturbance& disturbance, double velocity_rad_s,
                      double period_s) const noexcept;
};

}  // namespace strainwave
