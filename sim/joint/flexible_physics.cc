// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/flexible_physics.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"
#include "sim/joint/flexible_equations.h"

namespace strainwave {

using flexible::Equations;
using flexible::Modes;
using flexible::Torques;
using flexible::Vector;
using flexible::vector_of;

namespace {

constexpr int kMaxEventsPerSubstep = 32;
// Bristles and lost motion relax over a distance, which may be far shorter than the motion in a sub-step. At most
// this many steps follow it. A faster relaxation is slowed to the rate that they resolve; its end value is the same.
constexpr int kMaxRelaxationSteps = 64;

/// Integrates one constant input, sub-step by sub-step.
class Stepper {
 public:
  Stepper(const Equations& equations, const Vector& start) noexcept : equations_(equations), x_(start) {}

  const Vector& state() const noexcept { return x_; }

  void advance(double h) noexcept {
    for (int events = 0; h > 0.0; ++events) {
      const bool last = events >= kMaxEventsPerSubstep;
      const Modes modes = modes_at(x_, last);
      const double step_s = whole_step(modes, h, last);
      time_s_ += step_s;
      h -= step_s;
    }
  }

 private:
  /// Returns the direction in which each axis moves from here.
  Modes modes_at(const Vector& x, bool hold) const noexcept {
    const Torques t = equations_.torques(time_s_, x);
    Modes modes;
    modes.motor = x.motor_velocity != 0.0                     ? sign(x.motor_velocity)
                  : hold || equations_.breakaway_Nm(t) <= 0.0 ? 0.0
                                                              : sign(t.on_motor_Nm);
    if (!equations_.has_link()) return modes;
    const double link_static_Nm = equations_.link_static_Nm();
    // Without friction the link never sticks, even if no torque acts on it.
    modes.link = link_static_Nm <= 0.0                              ? 1.0
                 : x.link_velocity != 0.0                           ? sign(x.link_velocity)
                 : hold || std::abs(t.on_link_Nm) <= link_static_Nm ? 0.0
                                                                    : sign(t.on_link_Nm);
    return modes;
  }

  /// Above 0 if an axis has reversed, or a stuck one has broken away, at the end of a step.
  double event(const Vector& from, const Vector& x, const Modes& modes, double h) const noexcept {
    const Torques t = equations_.torques(time_s_ + h, x);
    double value = -1.0;
    if (!equations_.presliding()) {
      if (modes.motor == 0.0)
        value = std::max(value, equations_.breakaway_Nm(t));
      else if (from.motor_velocity != 0.0)
        value = std::max(value, -modes.motor * x.motor_velocity);
    }
    if (!equations_.has_link() || equations_.link_static_Nm() <= 0.0) return value;
    if (modes.link == 0.0) return std::max(value, std::abs(t.on_link_Nm) - equations_.link_static_Nm());
    return from.link_velocity != 0.0 ? std::max(value, -modes.link * x.link_velocity) : value;
  }

  /// Advances by `h`, or to the first event; returns the duration.
  double whole_step(Modes modes, double h, bool ignore_events) noexcept {
    const Vector from = x_;
    Vector to = equations_.runge_kutta(time_s_, from, modes, h);
    if (fell_back(from, to, modes)) {
      to = equations_.runge_kutta(time_s_, from, modes, h);
      ignore_events = true;
    }
    double step_s = h;
    if (!ignore_events && event(from, to, modes, h) > 0.0) {
      step_s = shorten(from, modes, h);
      to = equations_.runge_kutta(time_s_, from, modes, step_s);
    }
    // An axis that has reversed, or sticks, is at rest.
    if (!equations_.presliding() && (modes.motor == 0.0 || modes.motor * to.motor_velocity <= 0.0))
      to.motor_velocity = 0.0;
    if (equations_.has_link() && equations_.link_static_Nm() > 0.0 &&
        (modes.link == 0.0 || modes.link * to.link_velocity <= 0.0))
      to.link_velocity = 0.0;
    x_ = to;
    return step_s;
  }

  /// An axis that leaves rest and ends with the opposite velocity did not break away: it sticks over this step.
  bool fell_back(const Vector& from, const Vector& to, Modes& modes) const noexcept {
    bool changed = false;
    if (!equations_.presliding() && from.motor_velocity == 0.0 && modes.motor * to.motor_velocity < 0.0) {
      modes.motor = 0.0;
      changed = true;
    }
    if (equations_.has_link() && equations_.link_static_Nm() > 0.0 && from.link_velocity == 0.0 &&
        modes.link * to.link_velocity < 0.0) {
      modes.link = 0.0;
      changed = true;
    }
    return changed;
  }

  /// The shortest step, to rounding, at whose end the event has happened. False position finds it, with a
  /// bracket that is halved at least every third time.
  double shorten(const Vector& from, const Modes& modes, double h) const noexcept {
    const auto value = [&](double s) {
      return event(from, equations_.runge_kutta(time_s_, from, modes, s), modes, s);
    };
    double low = 0.0;
    double high = h;
    double f_low = event(from, from, modes, 0.0);
    double f_high = value(h);
    for (int i = 0; i < 100 && high - low > 1e-15 * (1.0 + h); ++i) {
      const double secant = f_high - f_low > 0.0 ? low - f_low * (high - low) / (f_high - f_low) : low;
      const bool bisect = i % 3 == 2 || !(secant > low && secant < high);
      const double s = bisect ? 0.5 * (low + high) : secant;
      const double f = value(s);
      (f > 0.0 ? high : low) = s;
      (f > 0.0 ? f_high : f_low) = f;
    }
    return high;
  }

  const Equations& equations_;
  Vector x_;
  double time_s_ = 0.0;
};

}  // namespace

void advance(FlexibleState& state, const FlexibleJoint& joint, const JointInput& input, double duration_s,
             int substeps) noexcept {
  const double substep_s = duration_s / substeps;
  const Equations equations(joint, input, state.current_Nm, kMaxRelaxationSteps / substep_s);
  Stepper stepper(equations, vector_of(state));
  for (int i = 0; i < substeps; ++i) {
    const double turns = equations.relaxation_per_s(stepper.state()) * substep_s;
    const int parts = 1 + static_cast<int>(std::min(turns, static_cast<double>(kMaxRelaxationSteps - 1)));
    for (int part = 0; part < parts; ++part) stepper.advance(substep_s / parts);
  }
  const Vector& x = stepper.state();
  const Torques t = equations.torques(duration_s, x);
  state.current_Nm = equations.current_Nm(duration_s);
  state.motor = {x.motor_position, x.motor_velocity,
                 !equations.presliding() && x.motor_velocity == 0.0 && equations.breakaway_Nm(t) <= 0.0};
  state.link = equations.has_link() ? JointState{x.link_position, x.link_velocity,
                                                 equations.link_static_Nm() > 0.0 && x.link_velocity == 0.0 &&
                                                     std::abs(t.on_link_Nm) <= equations.link_static_Nm()}
                                    : state.motor;
  state.lost_motion_rad = x.lost_motion;
  state.bristle_rad = x.bristle;
}

double transmitted_torque_Nm(const FlexibleJoint& joint, const FlexibleState& state) noexcept {
  const JointInput nothing;
  return Equations(joint, nothing, 0.0, 0.0).torques(0.0, vector_of(state)).transmitted_Nm;
}

double motor_torque_Nm(const FlexibleJoint& joint, const FlexibleState& state,
                       const JointInput& input) noexcept {
  return Equations(joint, input, state.current_Nm, 0.0).motor_Nm(state.current_Nm, vector_of(state));
}

namespace {

// Energy that the spring stores at a wind-up: over each slope, the difference of torque^2 / 2K.
double stored_energy_J(const TorsionSpring& spring, double wind_up_rad) noexcept {
  const double torque_Nm = std::abs(spring.torque_Nm(wind_up_rad));
  const double first_Nm = std::min(torque_Nm, spring.torque_1_Nm);
  const double second_Nm = std::clamp(torque_Nm, spring.torque_1_Nm, spring.torque_2_Nm);
  const double third_Nm = std::max(torque_Nm, spring.torque_2_Nm);
  return 0.5 *
         (first_Nm * first_Nm / spring.stiffness_1_Nm_rad +
          (second_Nm * second_Nm - spring.torque_1_Nm * spring.torque_1_Nm) / spring.stiffness_2_Nm_rad +
          (third_Nm * third_Nm - spring.torque_2_Nm * spring.torque_2_Nm) / spring.stiffness_3_Nm_rad);
}

}  // namespace

double mechanical_energy_J(const FlexibleJoint& joint, const FlexibleState& state) noexcept {
  const auto square = [](double x) { return x * x; };
  double energy_J = 0.5 * joint.motor.inertia_kgm2 * square(state.motor.velocity_rad_s);
  const GravityLoad& gravity = joint.effects.gravity;
  energy_J += gravity.torque_Nm * (1.0 - std::cos(state.link.position_rad - gravity.zero_rad));
  const Contact& contact = joint.effects.contact;
  energy_J +=
      0.5 * contact.stiffness_Nm_rad * square(std::max(0.0, state.link.position_rad - contact.position_rad));
  if (!joint.effects.transmission) return energy_J;
  const Transmission& gear = *joint.effects.transmission;
  const JointInput nothing;
  const double wind_up_rad = Equations(joint, nothing, 0.0, 0.0).wind_up_rad(vector_of(state));
  return energy_J + 0.5 * gear.link_inertia_kgm2 * square(state.link.velocity_rad_s) +
         stored_energy_J(gear.spring, wind_up_rad) +
         0.5 * gear.spring.stiffness_1_Nm_rad * square(state.lost_motion_rad);
}

}  // namespace strainwave
