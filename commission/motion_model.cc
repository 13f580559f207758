// SPDX-License-Identifier: BSD-3-Clause
#include "commission/motion_model.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {

// Longest Runge-Kutta step. The phase at 120 Hz is then right to 0.1 %.
constexpr double kLongestStep_s = 0.5e-3;
// Largest product of a swing's angular frequency and the step, well below the method's stability limit (2.8).
constexpr double kFastest = 1.5;

struct State {
  double motor_rad, motor_rad_s, link_rad, link_rad_s, lost_rad;
};

State moved(const State& a, double h, const State& by) {
  return {a.motor_rad + h * by.motor_rad, a.motor_rad_s + h * by.motor_rad_s, a.link_rad + h * by.link_rad,
          a.link_rad_s + h * by.link_rad_s, a.lost_rad + h * by.lost_rad};
}

/// External inputs at one instant.
struct Input {
  double torque_Nm;
  double error_rad;  ///< e
  double lead;       ///< 1 + e'
  double gravity_Nm;
};

Input between(const Input& a, const Input& b, double share) {
  return {a.torque_Nm, a.error_rad + share * (b.error_rad - a.error_rad), a.lead + share * (b.lead - a.lead),
          a.gravity_Nm + share * (b.gravity_Nm - a.gravity_Nm)};
}

/// The parameters in the form in which the equations use them.
struct Equations {
  double motor_kgm2, link_kgm2, damping_Nms_rad, friction_Nm, viscous_Nms_rad, share, direction;
  double half_lost_rad;
  TorsionSpring spring;

  /// Clamped to its bounds: a fast swing can leave them in a step, and would then diverge.
  double lost_rad(const State& x) const { return std::clamp(x.lost_rad, -half_lost_rad, half_lost_rad); }
  double transmitted_Nm(const State& x, const Input& in) const {
    const double bent_rad = x.motor_rad + in.error_rad - x.link_rad;
    const double bent_rad_s = in.lead * x.motor_rad_s - x.link_rad_s;
    return spring.torque_Nm(bent_rad) + spring.stiffness_1_Nm_rad * lost_rad(x) +
           damping_Nms_rad * bent_rad_s;
  }
  State slope(const State& x, const Input& in) const {
    const double bent_rad_s = in.lead * x.motor_rad_s - x.link_rad_s;
    const double ts = transmitted_Nm(x, in);
    const double friction =
        direction * (friction_Nm + share * std::abs(ts)) + viscous_Nms_rad * x.motor_rad_s;
    return {x.motor_rad_s, (in.torque_Nm - friction - in.lead * ts) / motor_kgm2, x.link_rad_s,
            (ts - in.gravity_Nm) / link_kgm2,
            half_lost_rad > 0.0 ? bent_rad_s - std::abs(bent_rad_s) * lost_rad(x) / half_lost_rad : 0.0};
  }
  State step(const State& x, const Input& begin, const Input& middle, const Input& end, double h) const {
    const State k1 = slope(x, begin);
    const State k2 = slope(moved(x, 0.5 * h, k1), middle);
    const State k3 = slope(moved(x, 0.5 * h, k2), middle);
    const State k4 = slope(moved(x, h, k3), end);
    return moved(moved(moved(moved(x, h / 6.0, k1), h / 3.0, k2), h / 3.0, k3), h / 6.0, k4);
  }
};

Equations equations_of(const MotionVector& p, const MotionWindow& window, const WindowVector& own,
                       const ToldJoint& told) {
  const double factor = std::exp(p[kLogStiffness]);
  return {std::exp(p[kLogMotorInertia]),
          std::exp(p[kLogLinkInertia]),
          std::exp(p[kLogDamping]),
          window.friction_Nm + own[4],
          p[kViscous],
          p[kShare],
          window.direction,
          0.5 * told.lost_motion_rad * std::exp(p[kLogLostMotion]),
          {factor * told.spring.stiffness_1_Nm_rad, told.spring.torque_1_Nm,
           factor * told.spring.stiffness_2_Nm_rad, told.spring.torque_2_Nm,
           factor * told.spring.stiffness_3_Nm_rad}};
}

/// A part of a period with one ordered torque.
struct Part {
  double begin, end;  ///< shares of the period
  int steps;
  double decay;   ///< of the current loop's error over half a step
  int order_ago;  ///< age of the order in periods
};

std::array<Part, 2> parts_of(double delay_periods, double lag_s, double period_s) {
  const int whole = static_cast<int>(std::floor(delay_periods));
  const double fraction = delay_periods - whole;
  const auto part = [&](double begin, double end, int ago) {
    const double length_s = (end - begin) * period_s;
    const int steps = static_cast<int>(std::ceil(length_s / kLongestStep_s - 1e-9));
    return Part{begin, end, steps, steps > 0 ? std::exp(-0.5 * length_s / steps / lag_s) : 1.0, ago};
  };
  return {part(0.0, fraction, whole + 1), part(fraction, 1.0, whole)};
}

}  // namespace

MotionModel::MotionModel(const JointTrace& trace, const ToldJoint& told) : trace_(trace), told_(told) {
  angles_.reserve(trace.samples.size());
  for (const JointSample& sample : trace.samples) {
    const double turn = told.gear_ratio * sample.motor_position_rad;
    angles_.push_back({std::sin(turn), std::cos(turn), std::sin(2.0 * turn), std::cos(2.0 * turn),
                       std::sin(sample.motor_position_rad), std::cos(sample.motor_position_rad)});
  }
}

void MotionModel::keep_in_bounds(MotionVector& p) const {
  p[kDelay] = std::clamp(p[kDelay], 0.0, kMaxDelayPeriods * trace_.period_s);
  p[kLogLag] = std::clamp(p[kLogLag], std::log(2e-5), std::log(5e-3));
  p[kLogStiffness] = std::clamp(p[kLogStiffness], std::log(0.2), std::log(5.0));
  p[kLogLostMotion] = std::clamp(p[kLogLostMotion], std::log(0.1), std::log(5.0));
  const double told_log = std::log(told_.motor_inertia_kgm2);
  p[kLogMotorInertia] = std::clamp(p[kLogMotorInertia], told_log - 2.0, told_log + 2.5);
  // With lost motion the spring is twice as stiff for small swings.
  const double stiffest = 2.0 * std::exp(p[kLogStiffness]) * told_.spring.stiffness_3_Nm_rad;
  const double least = stiffest * std::pow(kLongestStep_s / kFastest, 2);
  p[kLogLinkInertia] = std::clamp(p[kLogLinkInertia], std::log(least), told_log + 5.0);
  p[kLogDamping] = std::clamp(p[kLogDamping], std::log(1e-6 * stiffest),
                              std::log(std::exp(p[kLogLinkInertia]) * 0.5 / kLongestStep_s));
}

void MotionModel::simulate(const MotionVector& p, const MotionWindow& window, const WindowVector& own,
                           Eigen::Ref<Eigen::VectorXd> positions_rad) const {
  const Equations eq = equations_of(p, window, own, told_);
  const double lag_s = std::exp(p[kLogLag]);
  const std::array<Part, 2> parts = parts_of(p[kDelay] / trace_.period_s, lag_s, trace_.period_s);
  const auto ordered_Nm = [&](std::size_t at, int ago) {
    const auto back = static_cast<std::size_t>(ago);
    return trace_.samples[at > back ? at - back : 0].torque_ordered_Nm;
  };
  const double N = told_.gear_ratio;
  const auto input_at = [&](std::size_t at) {
    const Angles& a = angles_[at];
    return Input{0.0,
                 p[kError1Sin] * a[0] + p[kError1Cos] * a[1] + p[kError2Sin] * a[2] + p[kError2Cos] * a[3],
                 1.0 + N * (p[kError1Sin] * a[1] - p[kError1Cos] * a[0] +
                            2.0 * (p[kError2Sin] * a[3] - p[kError2Cos] * a[2])),
                 p[kGravitySin] * a[4] + p[kGravityCos] * a[5]};
  };

  Input from = input_at(window.first);
  State x{};
  x.motor_rad = trace_.samples[window.first].motor_position_rad + own[0];
  x.motor_rad_s = window.speed_rad_s + own[1];
  x.link_rad = x.motor_rad + from.error_rad - eq.spring.angle_rad(from.gravity_Nm) - own[2];
  x.link_rad_s = from.lead * x.motor_rad_s - own[3];
  double current_Nm = ordered_Nm(window.first, parts[1].order_ago + 1);
  for (std::size_t k = 0; k < window.count; ++k) {
    positions_rad[static_cast<Eigen::Index>(k)] = x.motor_rad;
    const std::size_t at = window.first + k;
    if (k + 1 == window.count) break;
    const Input to = input_at(at + 1);
    for (const Part& part : parts) {
      const double order_Nm = ordered_Nm(at, part.order_ago);
      for (int i = 0; i < part.steps; ++i) {
        const double step = (part.end - part.begin) / part.steps;
        const double share = part.begin + i * step;
        const double half_Nm = order_Nm + (current_Nm - order_Nm) * part.decay;
        const double end_Nm = order_Nm + (half_Nm - order_Nm) * part.decay;
        Input begin = between(from, to, share);
        Input middle = between(from, to, share + 0.5 * step);
        Input end = between(from, to, share + step);
        begin.torque_Nm = current_Nm;
        middle.torque_Nm = half_Nm;
        end.torque_Nm = end_Nm;
        x = eq.step(x, begin, middle, end, step * trace_.period_s);
        x.lost_rad = eq.lost_rad(x);
        current_Nm = end_Nm;
      }
    }
    from = to;
  }
}

}  // namespace strainwave
