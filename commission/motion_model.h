// SPDX-License-Identifier: BSD-3-Clause
// The model that an identification fits: motor and link on a spring, while the motor slides one way. It is simpler than the simulated
// joint: its friction does not stick. Joint side, SI. Not real-time.
//
//   Jm wm' = i - s (c + b s wm + r |ts|) - (1 + e') ts    s: direction of the motion, i: torque ordered, after delay and lag of the current loop
//   Jl wl' = ts - gs sin(thm) - gc cos(thm)
//   ts     = f spring(x) + f K1 z + D x'                  x = thm + e(N thm) - thl,  f: factor of the configured stiffness
//   z'     = x' - |x'| z / (h / 2)
//   e(a)   = e1 sin a + e2 cos a + e3 sin 2a + e4 cos 2a
//
// Gravity and e use the measured position, which differs from the model's by less than a wind-up.
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "commission/estimates.h"
#include "commission/joint_trace.h"

namespace strainwave {

/// The parameters in the order of the vector. Positive ones are logarithms.
enum MotionParameter : Eigen::Index {
  kLogMotorInertia,
  kLogLinkInertia,
  kLogStiffness,   ///< f
  kLogDamping,     ///< D
  kDelay,          ///< s
  kLogLag,         ///< of the current loop, s
  kViscous,        ///< b
  kLogLostMotion,  ///< h over the configured one
  kShare,          ///< r
  kGravitySin,
  kGravityCos,
  kError1Sin,
  kError1Cos,
  kError2Sin,
  kError2Cos,
  kMotionParameters
};
using MotionVector = Eigen::Matrix<double, kMotionParameters, 1>;

/// Parameters of one stretch, as deviations from the first guess: position, speed, wind-up, speed of wind-up, and friction c.
inline constexpr Eigen::Index kWindowParameters = 5;
using WindowVector = Eigen::Matrix<double, kWindowParameters, 1>;

/// A stretch of one-way motion.
struct MotionWindow {
  std::size_t first = 0;  ///< first sample
  std::size_t count = 0;
  double direction = 1.0;    ///< +1 or -1
  double speed_rad_s = 0.0;  ///< at its start, first guess, signed
  double friction_Nm = 0.0;  ///< c, first guess
  std::size_t stroke = 0;    ///< number of the motion between two reversals to which it belongs
};

class MotionModel {
 public:
  /// Keeps a reference to `trace`.
  MotionModel(const JointTrace& trace, const ToldJoint& told);

  /// Writes the motor position at each sample of `window` to `positions_rad`.
  void simulate(const MotionVector& parameters, const MotionWindow& window, const WindowVector& own,
                Eigen::Ref<Eigen::VectorXd> positions_rad) const;

  const JointTrace& trace() const noexcept { return trace_; }
  const ToldJoint& told() const noexcept { return told_; }
  /// Clamps `parameters` to plausible bounds, and to those in which the model's steps resolve the link's swing on the spring.
  void keep_in_bounds(MotionVector& parameters) const;

  /// Largest delay.
  static constexpr double kMaxDelayPeriods = 8.0;

 private:
  /// sin and cos of the motor's angle, of twice that, and of the joint's position.
  using Angles = std::array<double, 6>;

  const JointTrace& trace_;
  ToldJoint told_;
  std::vector<Angles> angles_;  ///< of each sample
};

}  // namespace strainwave
