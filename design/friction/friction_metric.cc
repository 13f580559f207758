// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_metric.h"

namespace strainwave {

Eigen::Matrix3d friction_metric(FitWeighting weighting, const std::vector<double>& motor_speeds_rpm) {
  if (weighting == FitWeighting::kSource) return Eigen::Matrix3d::Identity();
  Eigen::Matrix3d metric = Eigen::Matrix3d::Zero();
  metric(0, 0) = 1.0;
  const auto count = static_cast<double>(motor_speeds_rpm.size());
  for (const double speed : motor_speeds_rpm) {
    const Eigen::Vector2d torque(1.0, speed);
    metric.bottomRightCorner<2, 2>() += torque * torque.transpose() / count;
  }
  return metric;
}

FitTargets fit_targets(const FrictionData& data) {
  FitTargets targets;
  const auto count = static_cast<Eigen::Index>(data.points.size());
  targets.temperature_C.resize(count);
  targets.parameters.resize(count, 3);
  for (Eigen::Index k = 0; k < count; ++k) {
    const FrictionPoint& point = data.points[static_cast<std::size_t>(k)];
    targets.temperature_C(k) = point.temperature_C;
    targets.parameters.row(k) << point.motor_static_Ncm, point.motor_coulomb_Ncm,
        point.motor_viscous_Ncm_per_rpm;
  }
  return targets;
}

double metric_cost(const Eigen::MatrixX3d& errors, const Eigen::Matrix3d& metric) {
  return 0.5 * ((errors * metric).array() * errors.array()).sum();
}

}  // namespace strainwave
