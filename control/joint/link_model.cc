// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/link_model.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "control/joint/riccati.h"

namespace strainwave {

namespace {

using Matrix = Eigen::Matrix4d;
using Vector = Eigen::Vector4d;  // the members of LinkState, in their order

// Steps of the Runge-Kutta method: the angle of a swing in one step, which has a relative error of some 1e-5. At a period of 1 ms the most
// steps suffice for swings up to 600 Hz; for faster ones the method is less exact, but still stable.
constexpr double kStep_rad = 0.25;
constexpr int kMostSteps = 16;

// Weights of the regulator. This share of the torque limit costs as much ...
constexpr double kTorqueShare = 0.12;
// ... as errors of these shares of the wind-up that the torque makes, and of the velocity of its swing. Found on the grid of
// docs/flexible-joint.md: with half or twice each weight the joint ends within some ten microradians of the same position.
constexpr double kLinkShare = 1.0 / 86.0;
constexpr double kMotorShare = 1.0 / 14.0;
constexpr double kSpeedShare = 1.0 / 12.0;

struct Sampled {
  Matrix A;
  Vector B;
};

// Samples the linear joint over a period with the model's own steps.
Sampled sample(LinkModel joint, double period_s) noexcept {
  joint.spring = TorsionSpring::linear(joint.spring.stiffness_2_Nm_rad);
  joint.gravity = {};
  const auto column = [&](const LinkState& from, double torque_Nm) {
    const LinkState end = joint.advance(from, torque_Nm, period_s).end;
    return Vector(end.link_position_rad, end.link_velocity_rad_s, end.motor_position_rad,
                  end.motor_velocity_rad_s);
  };
  Sampled sampled;
  sampled.A.col(0) = column({1.0, 0.0, 0.0, 0.0}, 0.0);
  sampled.A.col(1) = column({0.0, 1.0, 0.0, 0.0}, 0.0);
  sampled.A.col(2) = column({0.0, 0.0, 1.0, 0.0}, 0.0);
  sampled.A.col(3) = column({0.0, 0.0, 0.0, 1.0}, 0.0);
  sampled.B = column({}, 1.0);
  return sampled;
}

int steps_in(const LinkModel& joint, double period_s) noexcept {
  const double swing_rad_s = free_free_frequency_rad_s(joint.motor_inertia_kgm2, joint.link_inertia_kgm2,
                                                       joint.spring.stiffness_3_Nm_rad);
  return std::clamp(static_cast<int>(std::ceil(period_s * swing_rad_s / kStep_rad)), 1, kMostSteps);
}

}  // namespace

LinkState moved(const LinkState& from, const LinkState& by, double share) noexcept {
  return {from.link_position_rad + share * by.link_position_rad,
          from.link_velocity_rad_s + share * by.link_velocity_rad_s,
          from.motor_position_rad + share * by.motor_position_rad,
          from.motor_velocity_rad_s + share * by.motor_velocity_rad_s};
}

LinkModel::Period LinkModel::advance(const LinkState& from, double torque_Nm,
                                     double period_s) const noexcept {
  const auto slope = [&](const LinkState& at) {
    const double transmitted_Nm = spring.torque_Nm(at.motor_position_rad - at.link_position_rad) +
                                  damping_Nms_rad * (at.motor_velocity_rad_s - at.link_velocity_rad_s);
    return LinkState{at.link_velocity_rad_s,
                     (transmitted_Nm - gravity.at(at.link_position_rad)) / link_inertia_kgm2,
                     at.motor_velocity_rad_s, (torque_Nm - transmitted_Nm) / motor_inertia_kgm2};
  };
  const int steps = 2 * ((steps_in(*this, period_s) + 1) / 2);  // an even number: one step ends half-way
  const double h = period_s / steps;
  Period period{from, 0.0};
  for (int step = 0; step < steps; ++step) {
    if (2 * step == steps) period.middle_velocity_rad_s = period.end.motor_velocity_rad_s;
    const LinkState first = slope(period.end);
    const LinkState second = slope(moved(period.end, first, 0.5 * h));
    const LinkState third = slope(moved(period.end, second, 0.5 * h));
    const LinkState fourth = slope(moved(period.end, third, h));
    for (const auto& [part, weight] : {std::pair{&first, 1.0 / 6.0}, std::pair{&second, 1.0 / 3.0},
                                       std::pair{&third, 1.0 / 3.0}, std::pair{&fourth, 1.0 / 6.0}})
      period.end = moved(period.end, *part, weight * h);
  }
  return period;
}

LinkGains LinkModel::regulate(double torque_limit_Nm, double period_s) const noexcept {
  const auto [A, B] = sample(*this, period_s);
  const double torque_Nm = kTorqueShare * torque_limit_Nm;
  const double wind_up_rad = torque_Nm / spring.stiffness_2_Nm_rad;
  const double speed_rad_s = wind_up_rad * free_free_frequency_rad_s(motor_inertia_kgm2, link_inertia_kgm2,
                                                                     spring.stiffness_2_Nm_rad);
  const auto weight = [](double scale) { return 1.0 / (scale * scale); };
  const Vector weights(weight(kLinkShare * wind_up_rad), weight(kSpeedShare * speed_rad_s),
                       weight(kMotorShare * wind_up_rad), weight(kSpeedShare * speed_rad_s));
  const double torque_weight = weight(torque_Nm);
  const auto P = solve_riccati(A, B, weights, torque_weight);
  assert(P);  // a spring and a torque on one of its ends can always be stabilised
  if (!P) return {};
  const Eigen::RowVector4d gains = B.transpose() * *P / (torque_weight + B.dot(*P * B));
  return {gains(0), gains(1), gains(2), gains(3)};
}

double regulated_torque_Nm(const LinkGains& gains, const LinkState& should_be, const LinkState& is) noexcept {
  return gains.link_position * (should_be.link_position_rad - is.link_position_rad) +
         gains.link_velocity * (should_be.link_velocity_rad_s - is.link_velocity_rad_s) +
         gains.motor_position * (should_be.motor_position_rad - is.motor_position_rad) +
         gains.motor_velocity * (should_be.motor_velocity_rad_s - is.motor_velocity_rad_s);
}

}  // namespace strainwave
