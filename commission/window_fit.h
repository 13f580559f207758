// SPDX-License-Identifier: BSD-3-Clause
// Fits a MotionModel to all stretches of one-way motion at once by the Levenberg-Marquardt method. The own parameters of each stretch are
// eliminated stretch by stretch. Not real-time.
//
// Residuals are differences of the position error over three periods. They weight slow errors, such as friction that varies with the
// position, and the encoder's counts about equally.
#pragma once

#include <vector>

#include "commission/motion_model.h"

namespace strainwave {

/// Prior knowledge of the parameters. A standard deviation of 0 means none.
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

  /// Runs at most `iterations` steps. Returns whether the fit converged.
  bool run(int iterations);

  const MotionVector& parameters() const { return parameters_; }
  double cost() const { return cost_; }
  /// Root mean square of the residuals.
  double residual_rad() const;
  /// Covariance of the parameters. The stretches of one stroke share errors of the model. Each stroke is left out in turn, and the spread
  /// of the results counts. This is the cluster jackknife (MacKinnon, Nielsen and Webb, Journal of Applied Econometrics 38, 2023) to first
  /// order, plus the share of the prior.
  Covariance covariance() const;
  /// Number of motions from one reversal to the next to which the stretches belong.
  int strokes() const;

 private:
  using OwnNormal = Eigen::Matrix<double, kWindowParameters, kWindowParameters>;
  using OwnSlopes = Eigen::Matrix<double, Eigen::Dynamic, kWindowParameters>;

  struct Stretch {
    MotionWindow window;
    WindowVector own = WindowVector::Zero();
    // Results of the last linearisation.
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
  /// Fits the stretch's own parameters to the present common ones.
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
  double count_ = 0.0;  ///< number of residuals
  double cost_ = 0.0;
  double prior_variance_ = 0.0;  ///< noise variance that weights the prior
};

}  // namespace strainwave
