// SPDX-License-Identifier: BSD-3-Clause
// The cost of a friction fit: 1/2 sum over temperatures of d' M d. d = the errors of (static, Coulomb,
// viscous) friction at the motor side in N.cm, N.cm, N.cm/RPM. Offline.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "design/friction/catalogue.h"

namespace strainwave {

enum class FitWeighting {
  /// M = I, Zhao (2006), (4-5). Viscous friction is 1e-3 of the others in these units and hardly counts.
  kSource,
  /// The squared error of the friction torque: that of static friction, plus the mean of (Coulomb error + s *
  /// viscous error)^2 over the catalogue's speeds s. Unit (N.cm)^2, as in Zhao (2006), but every parameter
  /// counts by its effect on the torque.
  kTorque,
};

Eigen::Matrix3d friction_metric(FitWeighting weighting, const std::vector<double>& motor_speeds_rpm);

/// The data as matrices: n temperatures, and n x 3 parameters (static, Coulomb, viscous).
struct FitTargets {
  Eigen::VectorXd temperature_C;
  Eigen::MatrixX3d parameters;
};
FitTargets fit_targets(const FrictionData& data);

/// 1/2 sum d' M d over the rows d of `errors`.
double metric_cost(const Eigen::MatrixX3d& errors, const Eigen::Matrix3d& metric);

}  // namespace strainwave
