// SPDX-License-Identifier: BSD-3-Clause
// Friction over temperature fitted to catalogue points: the exponential law and the fuzzy rules. Motor side,
// catalogue units. Offline. Source: Zhao (2006), (2-7)..(2-9), (3-5)..(3-8), (4-5), section 4.3.2.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "control/friction/friction.h"
#include "control/friction/fuzzy_friction.h"
#include "design/friction/linear_fit.h"

namespace strainwave {

/// p(T) = p0 + p1 exp(-(T - reference_C)/decay_C). reference_C is redundant with p1 and set to the lowest
/// temperature of the data.
struct ExponentialFit {
  double reference_C = 0.0;
  double decay_C = 0.0;
  Eigen::RowVector3d p0, p1;  ///< static, Coulomb, viscous
  double cost = 0.0;
  double gradient = 0.0;   ///< derivative of the cost over decay_C
  double curvature = 0.0;  ///< Gauss-Newton's approximation of the second derivative
};

/// Rules mu_i = exp(-((T - center_i)/width_i)^2), centres ascending, and their parameters.
struct FuzzyFit {
  Eigen::VectorXd center_C, width_C;
  Eigen::MatrixX3d consequents;  ///< one row per rule: static, Coulomb, viscous
  double cost = 0.0;
  /// Derivative of the cost, and Gauss-Newton's approximation of the second derivative, over [centres,
  /// widths] in the order of the arguments.
  Eigen::VectorXd gradient;
  Eigen::MatrixXd curvature;
};

/// Input of both fits.
struct FitProblem {
  FitTargets targets;
  Eigen::Matrix3d metric = Eigen::Matrix3d::Identity();
  bool physical = true;  ///< parameters non-negative and not increasing with temperature
};

/// Normalised memberships of n temperatures in m rules, n x m. The log domain avoids 0/0 far from every centre.
Eigen::MatrixXd normalised_memberships(const Eigen::VectorXd& temperature_C, const Eigen::VectorXd& center_C,
                                       const Eigen::VectorXd& width_C);

/// The best p0, p1 for a given decay_C > 0.
ExponentialFit fit_exponential_at(const FitProblem& problem, double decay_C);
/// The best decay_C in [low, high] as well: a scan, then golden section around the best of it.
ExponentialFit fit_exponential(const FitProblem& problem, double low_C, double high_C);

/// The best consequents for given memberships, in any order (returned by ascending centre; the derivatives
/// keep the order of the arguments).
FuzzyFit fit_consequents(const FitProblem& problem, const Eigen::VectorXd& center_C,
                         const Eigen::VectorXd& width_C);

/// Fixed memberships for plain least squares, for friction that falls steeply in the cold and levels off.
/// From min to max, the gap between centres grows by a factor of 1.6. A width is 0.8 of the geometric mean of
/// the gaps beside it. count >= 2.
struct Memberships {
  Eigen::VectorXd center_C, width_C;
};
Memberships graded_memberships(Eigen::Index count, double min_C, double max_C);

/// Parameters (static, Coulomb, viscous) at the data's temperatures.
Eigen::MatrixX3d predict(const ExponentialFit& fit, const Eigen::VectorXd& temperature_C);
Eigen::MatrixX3d predict(const FuzzyFit& fit, const Eigen::VectorXd& temperature_C);

/// To the joint side, SI.
ExponentialTemperatureLaw to_joint_side(const ExponentialFit& fit, double gear_ratio);
/// With the velocity memberships of Zhao (2006), given at the motor side in RPM; [min, max] is the range of the data.
FuzzyFriction to_joint_side(const FuzzyFit& fit, double gear_ratio, double temperature_min_C,
                            double temperature_max_C);
VelocityMemberships source_velocity_memberships(double gear_ratio);

}  // namespace strainwave
