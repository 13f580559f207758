#include "design/friction_regression.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <sstream>

#include "base/input_error.h"
#include "design/student.h"

namespace strainwave {

namespace {

// Columns have been scaled to length 1: beyond this condition a parameter is not determined by the speeds.
constexpr double kWorstCondition = 1e4;

[[noreturn]] void refuse(const std::vector<SteadyPoint>& points, const StribeckShape& shape) {
  std::ostringstream text;
  text << points.size() << " speeds at " << points.front().temperature_C
       << " degC do not tell static, Coulomb and viscous friction apart: at least " << kLeastRegressionPoints
       << " are needed, some below " << shape.velocity_rad_s << " rad/s and some well above";
  throw InputError(text.str());
}

}  // namespace

Eigen::RowVector3d friction_row(const StribeckShape& shape, double speed_rad_s) {
  return {std::exp(-std::pow(speed_rad_s / shape.velocity_rad_s, shape.exponent)), 1.0, speed_rad_s};
}

FrictionRegression regress_friction(const std::vector<SteadyPoint>& points, const StribeckShape& shape,
                                    double confidence) {
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
  // Squares of the singular values, rising.
  const Eigen::Matrix3d gram = scaled.transpose() * scaled;
  const Eigen::Vector3d squares =
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(gram, Eigen::EigenvaluesOnly).eigenvalues();
  if (!(scale.minCoeff() > 0.0) || !(squares(0) * kWorstCondition * kWorstCondition > squares(2)))
    refuse(points, shape);

  const Eigen::Matrix3d inverse = (X.transpose() * X).ldlt().solve(Eigen::Matrix3d::Identity());
  const Eigen::Vector3d parameters = inverse * (X.transpose() * F);
  result.points = static_cast<int>(n);
  result.residual_squares = (F - X * parameters).squaredNorm();
  result.degrees_of_freedom = static_cast<int>(n) - 3;
  const double variance = result.residual_squares / result.degrees_of_freedom;
  const double t = student_t(confidence, result.degrees_of_freedom);
  const auto interval = [&](const Eigen::Vector3d& combination) {
    return Interval{combination.dot(parameters),
                    t * std::sqrt(variance * combination.dot(inverse * combination))};
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
