// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/friction_regression.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <utility>

#include "base/input_error.h"
#include "base/printable.h"
#include "design/friction/student.h"

namespace strainwave {

namespace {

// Above this condition number of the columns, scaled to length 1, the speeds do not determine a parameter.
constexpr double kWorstCondition = 1e4;
// Below the resolution of any torque: (1e-9 N.m)^2.
constexpr double kLeastVariance_N2m2 = 1e-18;

[[noreturn]] void refuse(const std::vector<SteadyPoint>& points, const StribeckShape& shape) {
  std::ostringstream text;
  text << "static, Coulomb and viscous friction cannot be distinguished by "
       << counted(points.size(), "speed") << " at " << points.front().temperature_C << " degC: at least "
       << kLeastRegressionPoints << " are needed, some below " << shape.velocity_rad_s
       << " rad/s and some well above";
  throw InputError(text.str());
}

}  // namespace

Eigen::RowVector3d friction_row(const StribeckShape& shape, double speed_rad_s) {
  return {std::exp(-std::pow(speed_rad_s / shape.velocity_rad_s, shape.exponent)), 1.0, speed_rad_s};
}

double ripple_Nm(const StribeckShape& shape, double static_less_coulomb_Nm, const SteadyPoint& point) {
  const double delta = shape.exponent;
  const double power = std::pow(point.speed_rad_s / shape.velocity_rad_s, delta);
  // Applying s' = -s delta power / w twice gives s''.
  const double curvature = std::exp(-power) * delta * power * (delta * power - delta + 1.0) /
                           (point.speed_rad_s * point.speed_rad_s);
  return 0.5 * std::abs(curvature * static_less_coulomb_Nm) * point.speed_deviation_rad_s *
         point.speed_deviation_rad_s;
}

FrictionRegression regress_friction(const std::vector<SteadyPoint>& points, const StribeckShape& shape,
                                    double confidence, double torque_uncertainty) {
  const auto n = static_cast<Eigen::Index>(points.size());
  if (n < kLeastRegressionPoints) refuse(points, shape);
  Eigen::MatrixX3d X(n, 3);
  Eigen::VectorXd F(n);
  FrictionRegression result;
  for (Eigen::Index i = 0; i < n; ++i) {
    const SteadyPoint& point = points[static_cast<std::size_t>(i)];
    X.row(i) = friction_row(shape, point.speed_rad_s);
    F(i) = point.friction_Nm;
    result.temperature_C += point.temperature_C / static_cast<double>(n);
  }
  const Eigen::Vector3d scale = X.colwise().norm().transpose();
  const Eigen::MatrixX3d scaled = X * scale.cwiseInverse().asDiagonal();
  // Squares of the singular values, ascending.
  const Eigen::Matrix3d gram = scaled.transpose() * scaled;
  const Eigen::Vector3d squares =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(gram, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(scale.minCoeff() > 0.0) || !(squares(0) * kWorstCondition * kWorstCondition > squares(2)))
    refuse(points, shape);

  const auto solve = [&](const Eigen::MatrixXd& errors) -> std::pair<Eigen::Vector3d, Eigen::Matrix3d> {
    const Eigen::MatrixX3d weighted = errors.llt().solve(X);
    const Eigen::Matrix3d covariance = (X.transpose() * weighted).ldlt().solve(Eigen::Matrix3d::Identity());
    return {covariance * (weighted.transpose() * F), covariance};
  };
  const Eigen::Vector3d plain = solve(Eigen::MatrixXd::Identity(n, n)).first;
  result.points = static_cast<int>(n);
  result.residual_squares = (F - X * plain).squaredNorm();
  result.degrees_of_freedom = static_cast<int>(n) - 3;
  const double noise_squared = result.residual_squares / result.degrees_of_freedom;
  Eigen::VectorXd variance(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double torque_Nm = torque_uncertainty * F(i);
    const double speed_Nm = ripple_Nm(shape, plain(0), points[static_cast<std::size_t>(i)]);
    variance(i) = noise_squared + torque_Nm * torque_Nm + speed_Nm * speed_Nm;
  }
  // A floor keeps the variances above 0. Points without any error then all weigh the same.
  const double least = std::max(kLeastVariance_N2m2, variance.minCoeff());
  Eigen::MatrixXd errors = variance.cwiseMax(least).asDiagonal();
  const Eigen::VectorXd common_Nm = torque_uncertainty * (X * plain);
  errors += common_Nm * common_Nm.transpose();
  const auto weighed = solve(errors);
  const Eigen::Vector3d& parameters = weighed.first;
  const Eigen::Matrix3d& covariance = weighed.second;
  const double t = student_t(confidence, result.degrees_of_freedom);
  const auto interval = [&](const Eigen::Vector3d& combination) {
    return Interval{combination.dot(parameters), t * std::sqrt(combination.dot(covariance * combination))};
  };
  result.static_Nm = interval({1.0, 1.0, 0.0});
  result.coulomb_Nm = interval({0.0, 1.0, 0.0});
  result.viscous_Nms_rad = interval({0.0, 0.0, 1.0});
  return result;
}

std::vector<std::vector<SteadyPoint>> group_by_temperature(std::vector<SteadyPoint> points, double gap_C) {
  std::ranges::stable_sort(points, {}, &SteadyPoint::temperature_C);
  std::vector<std::vector<SteadyPoint>> groups;
  for (const SteadyPoint& point : points) {
    if (groups.empty() || point.temperature_C - groups.back().back().temperature_C > gap_C)
      groups.emplace_back();
    groups.back().push_back(point);
  }
  return groups;
}

}  // namespace strainwave
