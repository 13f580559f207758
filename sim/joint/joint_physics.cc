// SPDX-License-Identifier: BSD-3-Clause
#include "sim/joint/joint_physics.h"

#include <cmath>

#include "base/units.h"

namespace strainwave {

namespace {

/// One Runge-Kutta step while friction has the sign of `direction`.
struct Step {
  double end_velocity_rad_s;
  double displacement_rad;
  double start_acceleration_rad_s2;
};

Step runge_kutta_step(const JointParameters& joint, const JointInput& input, double direction,
                      double velocity_rad_s, double h) noexcept {
  const auto slope = [&](double w) { return moving_acceleration_rad_s2(joint, input, direction, w); };
  const double k1 = slope(velocity_rad_s);
  const double k2 = slope(velocity_rad_s + 0.5 * h * k1);
  const double k3 = slope(velocity_rad_s + 0.5 * h * k2);
  const double k4 = slope(velocity_rad_s + h * k3);
  return {velocity_rad_s + h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4),
          h * velocity_rad_s + h * h / 6.0 * (k1 + k2 + k3), k1};
}

/// Cubic Hermite polynomial of the velocity over one step, s in [0, 1].
struct DenseOutput {
  double c0, c1, c2, c3;

  DenseOutput(double w0, double w1, double slope0_times_h, double slope1_times_h)
      : c0(w0),
        c1(slope0_times_h),
        c2(3.0 * (w1 - w0) - 2.0 * slope0_times_h - slope1_times_h),
        c3(2.0 * (w0 - w1) + slope0_times_h + slope1_times_h) {}
  double value(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
  double slope(double s) const { return c1 + s * (2.0 * c2 + s * 3.0 * c3); }
  double integral(double s) const { return s * (c0 + s * (c1 / 2.0 + s * (c2 / 3.0 + s * c3 / 4.0))); }
};

/// Root of `velocity` in [0, 1], given value(0) of the sign `direction` and value(1) of the other sign or
/// zero. Newton kept inside a shrinking bracket; 60 halvings reach rounding even when every Newton step is refused.
double find_root(const DenseOutput& velocity, double direction) noexcept {
  double low = 0.0;
  double high = 1.0;
  double s = 0.5;
  for (int i = 0; i < 60; ++i) {
    const double value = direction * velocity.value(s);
    (value > 0.0 ? low : high) = s;
    const double newton = s - value / (direction * velocity.slope(s));
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == s || high - low <= 1e-16) break;
    s = next;
  }
  return s;
}

}  // namespace

double moving_acceleration_rad_s2(const JointParameters& joint, const JointInput& input, double direction,
                                  double velocity_rad_s) noexcept {
  const double along = direction * velocity_rad_s;
  double friction_Nm = input.friction.static_Nm;
  if (along != 0.0) {
    friction_Nm = stribeck_friction_Nm(input.friction, joint.stribeck, std::abs(along));
    if (along < 0.0) friction_Nm += 2.0 * input.friction.viscous_Nms_rad * along;
  }
  const double motor_Nm = input.motor.limit_Nm(input.torque_Nm, velocity_rad_s);
  return (motor_Nm - input.load_torque_Nm - direction * friction_Nm) / joint.inertia_kgm2;
}

void advance(JointState& state, const JointParameters& joint, const JointInput& input, double duration_s,
             int substeps) noexcept {
  const double rest_torque_Nm = input.motor.limit_Nm(input.torque_Nm, 0.0) - input.load_torque_Nm;
  const bool sticks_at_rest = std::abs(rest_torque_Nm) <= input.friction.static_Nm;
  const double substep_s = duration_s / substeps;
  double h = substep_s;  // remaining part of the current sub-step
  for (int i = 0; i < substeps;) {
    if (state.velocity_rad_s == 0.0) {
      state.stuck = sticks_at_rest;
      if (sticks_at_rest) return;  // nothing changes until the input does
    }
    const double direction = sign(state.velocity_rad_s != 0.0 ? state.velocity_rad_s : rest_torque_Nm);
    const Step step = runge_kutta_step(joint, input, direction, state.velocity_rad_s, h);
    if (direction * step.end_velocity_rad_s >= 0.0 || state.velocity_rad_s == 0.0) {
      state.position_rad += step.displacement_rad;
      state.velocity_rad_s = step.end_velocity_rad_s;
      h = substep_s;
      ++i;
      continue;
    }
    const double end_acceleration =
        moving_acceleration_rad_s2(joint, input, direction, step.end_velocity_rad_s);
    const DenseOutput velocity(state.velocity_rad_s, step.end_velocity_rad_s,
                               h * step.start_acceleration_rad_s2, h * end_acceleration);
    const double s = find_root(velocity, direction);
    state.position_rad += h * velocity.integral(s);
    state.velocity_rad_s = 0.0;
    h *= 1.0 - s;
    if (h <= 0.0) {
      h = substep_s;
      ++i;
    }
  }
  state.stuck = state.velocity_rad_s == 0.0 && sticks_at_rest;
}

}  // namespace strainwave
