// SPDX-License-Identifier: BSD-3-Clause
// Fits a MotionModel to stretches of one-way motion by Levenberg and Marquardt's method over all of them at once; what each stretch has
// of its own is eliminated stretch by stretch. Not real-time.
//
// Residuals are differences of the position's error over three periods. That weighs slow errors, such as friction that varies along the
// way, and the encoder's counts about equally.
#pragma once

#include <vector>

#include "commission/motion_model.h"

namespace strainwave {

/// What is known before: a standard deviation of 0 says nothing.
struct MotionPrior {
  MotionVector mean = MotionVector::Zero();
  MotionVector deviation = MotionVector::Zero();
};

class WindowFit {
 public:
  using Covariance = Eigen::Matrix<double, kMotionParameters, kMotionParameters>;

  /// Keeps a reference to `model`.
  WindowFit(const MotionModel& model, const MotionPrior& prior, const std::vector<MotionWindow>& windows,
            const MotionVector& start);

  /// At most so many steps; whether these were enough.
  bool run(int iterations);

  const MotionVector& parameters() const { return parameters_; }
  double cost() const { return cost_; }
  /// Root mean square of the residuals.
  double residual_rad() const;
  /// Of the parameters. Errors of the model are common to the stretches of one stroke. Each stroke is left out in turn, and the spread of
  /// what the others say counts: the jackknife by clusters (MacKinnon, Nielsen and Webb, Journal of Applied Econometrics 38, 2023), to
  /// first order.
  Covariance covariance() const;
  /// From one reversal to the next, that the stretches are parts of.
  int strokes() const;

 private:
  using OwnNormal = Eigen::Matrix<double, kWindowParameters, kWindowParameters>;
  using OwnSlopes = Eigen::Matrix<double, Eigen::Dynamic, kWindowParameters>;

  struct Stretch {
    MotionWindow window;
    WindowVector own = WindowVector::Zero();
    // Of the last linearisation.
    OwnNormal own_normal = OwnNormal::Zero();
    Eigen::Matrix<double, kWindowParameters, kMotionParameters> cross =
        Eigen::Matrix<double, kWindowParameters, kMotionParameters>::Zero();
    WindowVector own_right = WindowVector::Zero();
    MotionVector score =
        MotionVector::Zero();  ///< gradient of this stretch's squares, own parameters eliminated
    Covariance normal = Covariance::Zero();  ///< likewise
  };

  Eigen::VectorXd residuals(const Stretch& stretch, const MotionVector& parameters,
                            const WindowVector& own) const;
  OwnSlopes own_slopes(const Stretch& stretch, const Eigen::VectorXd& residuals) const;
  /// What the stretch has of its own, for the parameters as they are.
  void settle(Stretch& stretch);
  void linearise();
  void linearise(Stretch& stretch);
  double noise_variance() const;
  double prior_cost() const;
  double present_cost() const;

  const MotionModel& model_;
  MotionPrior prior_;
  std::vector<Stretch> stretches_;
  MotionVector parameters_;
  Covariance normal_ = Covariance::Zero();
  MotionVector right_ = MotionVector::Zero();
  double squares_ = 0.0;
  double count_ = 0.0;  ///< residuals
  double cost_ = 0.0;
  double prior_variance_ = 0.0;  ///< in units of which the prior counts
};

}  // namespace strainwave
