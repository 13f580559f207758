#include "control/joint_model.h"

#include <algorithm>
#include <cmath>

#include "control/units.h"

namespace strainwave {

namespace {

// Moves in `direction` (+1, -1) from `speed` >= 0 for at most `duration_s`, appending to `motion`. Returns
// the time that is left when the joint stops on the way, else 0.
double slide(const JointModel& model, double driving_Nm, double friction_offset_Nm, double direction,
             double speed, double duration_s, ModelMotion& motion) noexcept {
  const auto acceleration = [&](double at_speed) {
    return (direction * driving_Nm - model.friction_Nm(at_speed) - friction_offset_Nm) / model.inertia_kgm2;
  };
  // Midpoint rule; the middle of a sample that ends at rest is half its initial speed.
  const double middle = std::max(0.5 * speed, speed + 0.5 * duration_s * acceleration(speed));
  const double a = acceleration(middle);
  const bool stops = speed + duration_s * a < 0.0;
  const double moving_s = stops ? -speed / a : duration_s;
  const double end_speed = stops ? 0.0 : speed + duration_s * a;
  motion.moved = true;
  motion.displacement_rad += direction * 0.5 * moving_s * (speed + end_speed);
  motion.velocity_rad_s = direction * end_speed;
  const double displacement_by_torque = 0.5 * moving_s * moving_s / model.inertia_kgm2;
  const double velocity_by_torque = stops ? 0.0 : moving_s / model.inertia_kgm2;
  motion.displacement_by_velocity += speed > 0.0 ? moving_s : 0.0;
  motion.velocity_by_velocity = speed > 0.0 && !stops ? 1.0 : 0.0;
  motion.displacement_by_friction -= direction * displacement_by_torque;
  motion.velocity_by_friction = -direction * velocity_by_torque;
  motion.displacement_by_load -= displacement_by_torque;
  motion.velocity_by_load = -velocity_by_torque;
  motion.displacement_by_inertia -= direction * 0.5 * moving_s * (end_speed - speed);
  motion.velocity_by_inertia = stops ? 0.0 : -direction * (end_speed - speed);
  return duration_s - moving_s;
}

}  // namespace

double JointModel::friction_Nm(double velocity_rad_s) const noexcept {
  return velocity_rad_s == 0.0 ? friction.static_Nm
                               : std::abs(stribeck_friction_Nm(friction, stribeck, velocity_rad_s));
}

double JointModel::friction_along_Nm(double begin_rad_s, double end_rad_s) const noexcept {
  if (begin_rad_s * end_rad_s >= 0.0) {
    const double mean_rad_s = 0.5 * (begin_rad_s + end_rad_s);
    return sign(mean_rad_s) * friction_Nm(mean_rad_s);
  }
  const double change_rad_s = std::abs(begin_rad_s) + std::abs(end_rad_s);
  return (begin_rad_s * friction_Nm(0.5 * begin_rad_s) + end_rad_s * friction_Nm(0.5 * end_rad_s)) /
         change_rad_s;
}

ModelMotion JointModel::advance(double torque_Nm, const JointDisturbance& disturbance, double velocity_rad_s,
                                double period_s) const noexcept {
  const double driving_Nm = torque_Nm - disturbance.load_Nm;
  ModelMotion motion;
  double left_s = period_s;
  if (velocity_rad_s != 0.0)
    left_s = slide(*this, driving_Nm, disturbance.friction_offset_Nm, sign(velocity_rad_s),
                   std::abs(velocity_rad_s), period_s, motion);
  const bool breaks_away = std::abs(driving_Nm) > friction.static_Nm + disturbance.friction_offset_Nm;
  if (left_s > 0.0 && breaks_away)
    slide(*this, driving_Nm, disturbance.friction_offset_Nm, sign(driving_Nm), 0.0, left_s, motion);
  return motion;
}

}  // namespace strainwave
