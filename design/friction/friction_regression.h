// SPDX-License-Identifier: BSD-3-Clause
// Static, Coulomb and viscous friction at one temperature from the torques at several speeds, with confidence
// intervals. Joint side, SI. Offline.
//
//   F(w) = (Fs - Fc) s(w) + Fc + Fv w,   s(w) = exp(-(w/ws)^delta) known:   linear in (Fs - Fc, Fc, Fv)
//   least squares; noise^2 = residuals' squares / (n - 3)
//   S = diag(noise^2 + (torque_uncertainty F_i)^2 + ripple_i^2) + torque_uncertainty^2 F F'
//   generalised least squares; covariance (X'S^-1 X)^-1; interval by Student's t with n - 3
//
// The residuals alone do not show how well static friction is known: often a single slow point determines it, and the fit meets
// that point exactly. S therefore contains the possible error of that point, and that of a torque constant that is wrong for all
// points. The Stribeck velocity counts as known. If a joint has another one, its static friction lies outside of the interval.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "control/friction/friction.h"
#include "design/friction/steady_speed.h"

namespace strainwave {

/// Row of the model at one speed: factors of (Fs - Fc, Fc, Fv).
Eigen::RowVector3d friction_row(const StribeckShape& shape, double speed_rad_s);

/// Possible difference between the mean torque of a run and the friction at its mean speed, due to ripple of
/// the speed: 1/2 |s''(w)| (Fs - Fc) deviation^2, in N.m.
double ripple_Nm(const StribeckShape& shape, double static_less_coulomb_Nm, const SteadyPoint& point);

/// A value and the half width of its interval.
struct Interval {
  double value = 0.0;
  double half_width = 0.0;
};

struct FrictionRegression {
  double temperature_C = 0.0;  ///< mean of the points
  int points = 0;
  Interval static_Nm, coulomb_Nm, viscous_Nms_rad;
  double residual_squares = 0.0;  ///< N^2.m^2, sum
  int degrees_of_freedom = 0;
};

/// Points of about one temperature; at least kLeastRegressionPoints of different speeds. `torque_uncertainty`
/// >= 0: relative standard deviation of a torque. Throws InputError if they do not determine the three
/// parameters, with the speeds that are missing.
inline constexpr int kLeastRegressionPoints = 4;
FrictionRegression regress_friction(const std::vector<SteadyPoint>& points, const StribeckShape& shape,
                                    double confidence, double torque_uncertainty);

/// Sorts the points by temperature and groups them. A gap of more than `gap_C` begins a new group.
std::vector<std::vector<SteadyPoint>> group_by_temperature(std::vector<SteadyPoint> points, double gap_C);

}  // namespace strainwave
