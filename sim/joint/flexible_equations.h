// SPDX-License-Identifier: BSD-3-Clause
// The equations of sim/joint/flexible_physics.h: torques and derivatives of one state under one constant
// input. Only flexible_physics.cc includes this file. Real-time safe. Source: docs/flexible-joint.md.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "sim/joint/flexible_physics.h"

namespace strainwave::flexible {

/// The mode of each axis during a step: it slides in one direction, or sticks.
struct Modes {
  double motor = 0.0;  ///< +1, -1; 0: stuck
  double link = 0.0;
};

/// The state as one vector.
struct Vector {
  double motor_position, motor_velocity, link_position, link_velocity, lost_motion, bristle;
};

inline Vector operator+(const Vector& a, const Vector& b) noexcept {
  return {a.motor_position + b.motor_position, a.motor_velocity + b.motor_velocity,
          a.link_position + b.link_position,   a.link_velocity + b.link_velocity,
          a.lost_motion + b.lost_motion,       a.bristle + b.bristle};
}
inline Vector operator*(double s, const Vector& a) noexcept {
  return {s * a.motor_position, s * a.motor_velocity, s * a.link_position,
          s * a.link_velocity,  s * a.lost_motion,    s * a.bristle};
}

inline Vector vector_of(const FlexibleState& s) noexcept {
  return {s.motor.position_rad,  s.motor.velocity_rad_s, s.link.position_rad,
          s.link.velocity_rad_s, s.lost_motion_rad,      s.bristle_rad};
}

/// The torques at one instant. Friction of the motor and Coulomb friction of the link are not included.
struct Torques {
  double transmitted_Nm = 0.0;
  double on_motor_Nm = 0.0;  ///< without motor friction
  double on_link_Nm = 0.0;   ///< without Coulomb friction of the link
};

/// The equations for one constant input. Time counts from the start of that input.
class Equations {
 public:
  /// `fastest_per_s` limits the relaxation rate of bristles and lost motion.
  Equations(const FlexibleJoint& joint, const JointInput& input, double start_current_Nm,
            double fastest_per_s) noexcept
      : joint_(joint), input_(input), start_current_Nm_(start_current_Nm), fastest_per_s_(fastest_per_s) {}

  bool presliding() const noexcept { return joint_.effects.friction.presliding_rad > 0.0; }
  bool has_link() const noexcept { return joint_.effects.transmission.has_value(); }
  double link_static_Nm() const noexcept { return joint_.effects.transmission->link_coulomb_Nm; }

  /// Torque behind the current loop. The solution for its first-order lag is exact.
  double current_Nm(double time_s) const noexcept {
    const double lag_s = joint_.effects.drive.current_loop_s;
    if (lag_s <= 0.0) return input_.torque_Nm;
    return input_.torque_Nm + (start_current_Nm_ - input_.torque_Nm) * std::exp(-time_s / lag_s);
  }

  double motor_Nm(double current_Nm, const Vector& x) const noexcept {
    const DriveEffects& drive = joint_.effects.drive;
    double wanted_Nm = current_Nm;
    if (drive.ripple_share > 0.0)
      wanted_Nm *= 1.0 + drive.ripple_share * std::sin(drive.ripple_per_motor_turn * turn_rad(x));
    return input_.motor.limit_Nm(wanted_Nm, x.motor_velocity);
  }

  Torques torques(double time_s, const Vector& x) const noexcept {
    Torques result;
    const double motor_Nm = this->motor_Nm(current_Nm(time_s), x);
    const double outside_Nm = input_.load_torque_Nm + position_torque_Nm(x);
    if (!has_link()) {
      result.on_motor_Nm = motor_Nm - outside_Nm;
      return result;
    }
    const Transmission& gear = *joint_.effects.transmission;
    double lead = 1.0;
    result.transmitted_Nm = transmitted_Nm(x, lead);
    result.on_motor_Nm = motor_Nm - lead * result.transmitted_Nm;
    result.on_link_Nm = result.transmitted_Nm - outside_Nm - gear.link_viscous_Nms_rad * x.link_velocity;
    return result;
  }

  /// Friction parameters, with the part due to the transmitted torque, for motion in `direction`; 0: the mean of both directions.
  FrictionParameters friction(double transmitted_Nm, double direction) const noexcept {
    const FrictionEffects& effects = joint_.effects.friction;
    const FrictionParameters& curve = input_.friction;
    const double added_Nm = effects.transmitted_share * std::abs(transmitted_Nm);
    const double share = 1.0 + effects.direction_share * direction;
    return {share * (curve.static_Nm + added_Nm), share * (curve.coulomb_Nm + added_Nm),
            share * curve.viscous_Nms_rad};
  }
  /// The amount by which the torques on a motor at rest exceed its static friction.
  double breakaway_Nm(const Torques& t) const noexcept {
    return std::abs(t.on_motor_Nm) - friction(t.transmitted_Nm, sign(t.on_motor_Nm)).static_Nm;
  }

  /// The faster of the relaxation rates of bristles and lost motion in this state, 1/s.
  double relaxation_per_s(const Vector& x) const noexcept {
    double rate = 0.0;
    if (presliding()) {
      const FrictionParameters f = friction(0.0, sign(x.motor_velocity));
      rate = std::abs(x.motor_velocity) * bristle_stiffness_Nm_rad(0.0) / sliding_Nm(f, x.motor_velocity);
    }
    if (has_link() && gear().lost_motion.width_rad > 0.0)
      rate = std::max(rate, 2.0 * std::abs(wind_up_speed_rad_s(x)) / gear().lost_motion.width_rad);
    return rate;
  }

  Vector derivative(double time_s, const Vector& x, const Modes& modes) const noexcept {
    const Torques t = torques(time_s, x);
    Vector d{};
    d.motor_position = x.motor_velocity;
    if (presliding()) {
      const FrictionParameters f = friction(t.transmitted_Nm, sign(x.motor_velocity));
      const double stiffness = bristle_stiffness_Nm_rad(t.transmitted_Nm);
      d.bristle = relaxation(x.motor_velocity, sliding_Nm(f, x.motor_velocity) / stiffness, x.bristle);
      const double damping = std::sqrt(stiffness * joint_.motor.inertia_kgm2);
      d.motor_velocity = (t.on_motor_Nm - stiffness * x.bristle - damping * d.bristle -
                          f.viscous_Nms_rad * x.motor_velocity) /
                         joint_.motor.inertia_kgm2;
    } else if (modes.motor != 0.0) {
      d.motor_velocity =
          (t.on_motor_Nm - modes.motor * sliding_friction_Nm(t.transmitted_Nm, x, modes.motor)) /
          joint_.motor.inertia_kgm2;
    }
    if (!has_link()) {
      d.link_position = d.motor_position;
      d.link_velocity = d.motor_velocity;
      return d;
    }
    const Transmission& gear = *joint_.effects.transmission;
    d.link_position = x.link_velocity;
    if (modes.link != 0.0)
      d.link_velocity = (t.on_link_Nm - modes.link * gear.link_coulomb_Nm) / gear.link_inertia_kgm2;
    if (gear.lost_motion.width_rad > 0.0)
      d.lost_motion = relaxation(wind_up_speed_rad_s(x), 0.5 * gear.lost_motion.width_rad, x.lost_motion);
    return d;
  }

  Vector runge_kutta(double time_s, const Vector& x, const Modes& modes, double h) const noexcept {
    const Vector k1 = derivative(time_s, x, modes);
    const Vector k2 = derivative(time_s + 0.5 * h, x + (0.5 * h) * k1, modes);
    const Vector k3 = derivative(time_s + 0.5 * h, x + (0.5 * h) * k2, modes);
    const Vector k4 = derivative(time_s + h, x + h * k3, modes);
    return x + (h / 6.0) * (k1 + 2.0 * (k2 + k3) + k4);
  }

  double wind_up_rad(const Vector& x) const noexcept {
    const double error_rad =
        gear().kinematic_error.on() ? gear().kinematic_error.value_rad(turn_rad(x)) : 0.0;
    return x.motor_position + error_rad - x.link_position;
  }

 private:
  /// dz/dt of a deflection z that follows a motion up to `end_rad`: speed - |speed| z / end, with a limited rate.
  double relaxation(double speed_rad_s, double end_rad, double deflection_rad) const noexcept {
    const double rate = std::min(std::abs(speed_rad_s) / end_rad, fastest_per_s_);
    return rate * (std::copysign(end_rad, speed_rad_s) - deflection_rad);
  }
  const Transmission& gear() const noexcept { return *joint_.effects.transmission; }
  double turn_rad(const Vector& x) const noexcept { return joint_.effects.gear_ratio * x.motor_position; }

  double lead_of(const Vector& x) const noexcept {
    return gear().kinematic_error.on()
               ? 1.0 + joint_.effects.gear_ratio * gear().kinematic_error.slope(turn_rad(x))
               : 1.0;
  }
  double wind_up_speed_rad_s(const Vector& x) const noexcept {
    return lead_of(x) * x.motor_velocity - x.link_velocity;
  }
  double transmitted_Nm(const Vector& x, double& lead) const noexcept {
    lead = lead_of(x);
    return gear().spring.torque_Nm(wind_up_rad(x)) +
           gear().damping_Nms_rad * (lead * x.motor_velocity - x.link_velocity) +
           gear().spring.stiffness_1_Nm_rad * x.lost_motion;
  }
  double position_torque_Nm(const Vector& x) const noexcept {
    return joint_.effects.gravity.at(x.link_position) +
           joint_.effects.contact.torque_Nm(x.link_position, x.link_velocity);
  }
  double bristle_stiffness_Nm_rad(double transmitted_Nm) const noexcept {
    return friction(transmitted_Nm, 0.0).static_Nm / joint_.effects.friction.presliding_rad;
  }
  /// The Stribeck curve without its viscous part; > 0 also at rest.
  double sliding_Nm(const FrictionParameters& f, double velocity_rad_s) const noexcept {
    if (velocity_rad_s == 0.0) return f.static_Nm;
    const FrictionParameters dry{f.static_Nm, f.coulomb_Nm, 0.0};
    return stribeck_friction_Nm(dry, joint_.motor.stribeck, std::abs(velocity_rad_s));
  }
  /// Size of the motor's friction while it slides in `direction`, continued smoothly to the other sign of velocity.
  double sliding_friction_Nm(double transmitted_Nm, const Vector& x, double direction) const noexcept {
    const FrictionParameters f = friction(transmitted_Nm, direction);
    return sliding_Nm(f, x.motor_velocity) + f.viscous_Nms_rad * direction * x.motor_velocity;
  }

  const FlexibleJoint& joint_;
  const JointInput& input_;
  double start_current_Nm_;
  double fastest_per_s_;
};

}  // namespace strainwave::flexible
