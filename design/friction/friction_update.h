// SPDX-License-Identifier: BSD-3-Clause
// Merges measurements on one joint with the catalogue's friction of its type, by Bayesian least squares on
// the parameters of the fuzzy rules. Joint side, SI. Offline.
//
//   c = (Fs - Fc, Fc, Fv of every rule); the memberships stay the prior's
//   prior         c ~ N(c0, P0),  for each of the three kinds of parameter  P0 = common^2 c0 c0' + own^2 Q
//                 common: this joint may have more friction than the catalogue, at every temperature alike
//                 own:    its law over temperature may differ
//                 Q:      on average over the rules' range of temperature, the blended parameter deviates by 1 in
//                         units of itself (a single rule has no meaning, because rules overlap)
//   measurements  F = a(T, w)' c + e,  e ~ N(0, noise^2 + (torque_uncertainty F)^2 + ripple^2)
//   posterior     minimises (c - c0)' P0^-1 (c - c0) + sum (F - a'c)^2 / var(e)
//                 subject to  Fs >= Fc >= 0,  Fv >= 0,  Fc and Fv not rising with temperature
//                 covariance (P0^-1 + sum a a' / var(e))^-1, without the constraints
#pragma once

#include <Eigen/Core>
#include <vector>

#include "control/friction/fuzzy_friction.h"
#include "design/friction/friction_regression.h"

namespace strainwave {

/// Weights of catalogue and measurement: relative standard deviations, > 0.
struct UpdateWeights {
  double common = 0.3;
  double own = 0.1;
  double torque_uncertainty = 0.01;  ///< of torque measurement and Stribeck curve
};

class FrictionUpdate {
 public:
  /// `noise_Nm` >= 0: standard deviation of a point. Points outside the rules' range of temperature count at
  /// the end of the range.
  FrictionUpdate(const FuzzyFriction& prior, const StribeckShape& shape,
                 const std::vector<SteadyPoint>& points, double noise_Nm, const UpdateWeights& weights);

  /// The rules with the merged parameters.
  const FuzzyFriction& friction() const { return friction_; }
  /// Friction torque at a temperature and speed, and its standard deviation in half_width.
  Interval friction_Nm(double temperature_C, double speed_rad_s) const;

 private:
  Eigen::RowVectorXd row(double temperature_C, double speed_rad_s) const;

  StribeckShape shape_;
  FuzzyFriction friction_;
  Eigen::VectorXd parameters_;  ///< c, three blocks of one entry per rule
  Eigen::MatrixXd covariance_;
};

}  // namespace strainwave
