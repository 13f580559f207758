// SPDX-License-Identifier: BSD-3-Clause
// fit_motion() of identification.h: Levenberg and Marquardt's method over all stretches at once. What each stretch has of its own is
// eliminated stretch by stretch. Residuals are differences of the position's error over kLag periods, which weighs slow errors, friction
// along the way, and the encoder's counts about equally.
#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "commission/identification.h"
#include "commission/motion_model.h"
#include "commission/motion_spans.h"

namespace strainwave {

namespace {

using Matrix = Eigen::Matrix<double, kMotionParameters, kMotionParameters>;
using OwnMatrix = Eigen::Matrix<double, kWindowParameters, kWindowParameters>;
using CrossMatrix = Eigen::Matrix<double, kWindowParameters, kMotionParameters>;

constexpr Eigen::Index kLag = 3;
constexpr std::size_t kLongWindow = 400;
constexpr std::size_t kShortWindow = 60;
constexpr std::size_t kLeastWindow = 120;
constexpr int kShortIterations = 6;
constexpr int kLongIterations = 25;
constexpr std::size_t kSearchWindows = 24;

/// What is known before: the parameter's spread, standard deviation; 0: nothing.
struct Prior {
  MotionVector mean = MotionVector::Zero();
  MotionVector deviation = MotionVector::Zero();
};

struct Stretch {
  MotionWindow window{};
  WindowVector own = WindowVector::Zero();
  // Of the last linearisation.
  OwnMatrix own_normal = OwnMatrix::Zero();
  CrossMatrix cross = CrossMatrix::Zero();
  WindowVector own_right = WindowVector::Zero();
  MotionVector score =
      MotionVector::Zero();  ///< gradient of this stretch's squares, own parameters eliminated
};

std::vector<Stretch> cut(const JointTrace& trace, const ToldJoint& told, std::size_t length) {
  std::vector<Stretch> stretches;
  for (const MotionSpan& span : sliding_spans(trace, told.gear_ratio, std::min(length, kLeastWindow))) {
    const std::size_t pieces = std::max<std::size_t>(1, (span.count + length / 2) / length);
    for (std::size_t i = 0; i < pieces; ++i) {
      const std::size_t first = span.first + i * span.count / pieces;
      const std::size_t end = span.first + (i + 1) * span.count / pieces;
      MotionWindow window{first, end - first, span.direction, speed_around(trace, first), 0.0};
      double torque = 0.0;
      for (std::size_t k = first; k < end; ++k) torque += trace.samples[k].torque_ordered_Nm;
      window.friction_Nm = span.direction * torque / static_cast<double>(window.count);
      stretches.emplace_back().window = window;
    }
  }
  return stretches;
}

/// Deviations by which own parameters are kept near their guesses: far wider than they are off. Position, speed, wind-up, its speed, c.
const WindowVector kOwnStep = (WindowVector() << 1e-6, 1e-4, 1e-6, 1e-4, 1e-3).finished();

class Fit {
 public:
  Fit(const MotionModel& model, Prior prior, std::vector<Stretch> stretches, MotionVector start)
      : model_(model),
        prior_(std::move(prior)),
        stretches_(std::move(stretches)),
        parameters_(std::move(start)) {
    model_.keep_in_bounds(parameters_);
  }

  void run(int iterations) {
    linearise();
    double damping = 1e-3;
    for (int i = 0; i < iterations; ++i) {
      const double before = cost_;
      const MotionVector kept = parameters_;
      std::vector<WindowVector> kept_own;
      for (const Stretch& stretch : stretches_) kept_own.push_back(stretch.own);
      Matrix damped = normal_;
      damped.diagonal() += damping * normal_.diagonal();
      const MotionVector change = damped.ldlt().solve(right_).cwiseMax(-0.7).cwiseMin(0.7);
      parameters_ += change;
      model_.keep_in_bounds(parameters_);
      const MotionVector moved = parameters_ - kept;
      for (Stretch& s : stretches_) s.own += s.own_normal.ldlt().solve(s.own_right - s.cross * moved);
      if (cost_of_present() < before) {
        damping = std::max(1e-7, damping * 0.2);
        linearise();
        if (before - cost_ < 1e-5 * before) break;
      } else {
        parameters_ = kept;
        for (std::size_t k = 0; k < stretches_.size(); ++k) stretches_[k].own = kept_own[k];
        damping *= 10.0;
        if (damping > 1e4) break;
      }
    }
  }

  const MotionVector& parameters() const { return parameters_; }
  double cost() const { return cost_; }
  double residual_rad() const { return std::sqrt(squares_ / std::max(1.0, count_)); }
  std::size_t windows() const { return stretches_.size(); }

  /// Covariance of the parameters. Errors of the model make residuals of one stretch depend on each other, so the spread of the
  /// stretches' scores counts, not that of the samples (White, Econometrica 48, 1980, by clusters).
  Matrix covariance() const {
    Matrix scores = Matrix::Zero();
    for (const Stretch& s : stretches_) scores += s.score * s.score.transpose();
    const auto n = static_cast<double>(stretches_.size());
    const double small = n / std::max(1.0, n - 4.0);
    Matrix middle = small * scores;
    const double variance = noise_variance();
    for (Eigen::Index i = 0; i < kMotionParameters; ++i)
      if (prior_.deviation[i] > 0.0) middle(i, i) += std::pow(variance / prior_.deviation[i], 2);
    const Matrix inverse = normal_.ldlt().solve(Matrix::Identity());
    return inverse * middle * inverse.transpose();
  }

 private:
  Eigen::VectorXd residuals(const Stretch& stretch, const MotionVector& parameters,
                            const WindowVector& own) const {
    const auto n = static_cast<Eigen::Index>(stretch.window.count);
    Eigen::VectorXd error(n);
    model_.simulate(parameters, stretch.window, own, error);
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto at = stretch.window.first + static_cast<std::size_t>(k);
      error[k] = model_.trace().samples[at].motor_position_rad - error[k];
    }
    return error.tail(n - kLag) - error.head(n - kLag);
  }

  double noise_variance() const { return std::max(squares_ / std::max(1.0, count_), 1e-16); }

  double prior_cost() const {
    double cost = 0.0;
    for (Eigen::Index i = 0; i < kMotionParameters; ++i)
      if (prior_.deviation[i] > 0.0)
        cost += std::pow((parameters_[i] - prior_.mean[i]) / prior_.deviation[i], 2);
    return cost * prior_variance_;
  }

  double cost_of_present() const {
    double squares = 0.0;
    for (const Stretch& stretch : stretches_)
      squares += residuals(stretch, parameters_, stretch.own).squaredNorm();
    return std::isfinite(squares) ? squares + prior_cost() : std::numeric_limits<double>::infinity();
  }

  void linearise() {
    normal_.setZero();
    right_.setZero();
    squares_ = count_ = 0.0;
    for (Stretch& s : stretches_) {
      const Eigen::VectorXd r = residuals(s, parameters_, s.own);
      Eigen::Matrix<double, Eigen::Dynamic, kMotionParameters> J(r.size(), kMotionParameters);
      Eigen::Matrix<double, Eigen::Dynamic, kWindowParameters> L(r.size(), kWindowParameters);
      for (Eigen::Index i = 0; i < kMotionParameters; ++i) {
        MotionVector p = parameters_;
        p[i] += step(i);
        J.col(i) = (r - residuals(s, p, s.own)) / step(i);
      }
      for (Eigen::Index i = 0; i < kWindowParameters; ++i) {
        WindowVector own = s.own;
        own[i] += kOwnStep[i];
        L.col(i) = (r - residuals(s, parameters_, own)) / kOwnStep[i];
      }
      s.own_normal = L.transpose() * L;
      s.own_normal.diagonal() *= 1.0 + 1e-9;
      // Position has no effect on differences, but through gravity: keep it where it is.
      s.own_normal(0, 0) += 1.0;
      s.own_right = L.transpose() * r;
      s.cross = L.transpose() * J;
      const Eigen::LDLT<OwnMatrix> own = s.own_normal.ldlt();
      s.score = J.transpose() * r - s.cross.transpose() * own.solve(s.own_right);
      normal_ += J.transpose() * J - s.cross.transpose() * own.solve(s.cross);
      right_ += s.score;
      squares_ += r.squaredNorm();
      count_ += static_cast<double>(r.size());
    }
    prior_variance_ = noise_variance();
    for (Eigen::Index i = 0; i < kMotionParameters; ++i) {
      if (prior_.deviation[i] <= 0.0) continue;
      const double weight = prior_variance_ / (prior_.deviation[i] * prior_.deviation[i]);
      normal_(i, i) += weight;
      right_[i] -= weight * (parameters_[i] - prior_.mean[i]);
    }
    cost_ = squares_ + prior_cost();
  }

  double step(Eigen::Index i) const {
    if (i == kDelay) return 1e-6;
    if (i >= kError1Sin) return 1e-7;
    return i == kViscous || i == kGravitySin || i == kGravityCos ? 1e-3 : 1e-4;
  }

  const MotionModel& model_;
  Prior prior_;
  std::vector<Stretch> stretches_;
  MotionVector parameters_;
  Matrix normal_ = Matrix::Zero();
  MotionVector right_ = MotionVector::Zero();
  double squares_ = 0.0, count_ = 0.0, cost_ = 0.0;
  double prior_variance_ = 0.0;  ///< in units of which the prior counts
};

Prior prior_of(const ToldJoint& told) {
  Prior prior;
  const auto set = [&](MotionParameter parameter, double mean, double deviation) {
    prior.mean[parameter] = mean;
    prior.deviation[parameter] = deviation;
  };
  const double K1 = told.spring.stiffness_1_Nm_rad;
  set(kLogMotorInertia, std::log(1.5 * told.motor_inertia_kgm2), 1.0);
  set(kLogLinkInertia, std::log(told.motor_inertia_kgm2), 2.0);
  set(kLogStiffness, 0.0, 0.5);
  set(kLogDamping, std::log(2.0 * 0.03 * std::sqrt(K1 * told.motor_inertia_kgm2 / 2.0)), 1.0);
  set(kDelay, 1.5e-3, 2e-3);
  set(kLogLag, std::log(3e-4), 1.0);
  set(kViscous, 0.0, 100.0 * told.motor_inertia_kgm2);
  set(kLogLostMotion, 0.0, 0.5);
  set(kShare, 0.05, 0.03);  // 5 to 10 %: docs/flexible-joint.md
  // A weight that hangs from the link: of any size against the spring's first corner.
  set(kGravitySin, 0.0, 2.0 * told.spring.torque_2_Nm);
  set(kGravityCos, 0.0, 2.0 * told.spring.torque_2_Nm);
  for (const MotionParameter error : {kError1Sin, kError1Cos, kError2Sin, kError2Cos}) set(error, 0.0, 3e-4);
  return prior;
}

/// The start from which short stretches, which a wrong resonance does not put out of phase, are explained best.
MotionVector search(const MotionModel& model, const Prior& prior) {
  std::vector<Stretch> all = cut(model.trace(), model.told(), kShortWindow);
  std::vector<Stretch> few;
  const std::size_t stride = std::max<std::size_t>(1, all.size() / kSearchWindows);
  for (std::size_t i = 0; i < all.size(); i += stride) few.push_back(all[i]);
  MotionVector best = prior.mean;
  double least = std::numeric_limits<double>::infinity();
  for (const double motor : {1.0, 1.8, 3.2})
    for (const double link : {0.2, 0.8, 3.0}) {
      MotionVector start = prior.mean;
      start[kLogMotorInertia] = std::log(motor * model.told().motor_inertia_kgm2);
      start[kLogLinkInertia] = start[kLogMotorInertia] + std::log(link);
      Fit fit(model, prior, few, start);
      fit.run(kShortIterations);
      if (fit.cost() >= least) continue;
      least = fit.cost();
      best = fit.parameters();
    }
  return best;
}

/// Of a function of the parameters: its value, and 1.96 standard deviations by its gradient.
template <typename Function>
Estimate estimate_of(const MotionVector& p, const Matrix& covariance, Function function) {
  MotionVector gradient;
  for (Eigen::Index i = 0; i < kMotionParameters; ++i) {
    const double step = std::max(1e-7, 1e-5 * std::abs(p[i]));
    MotionVector up = p;
    MotionVector down = p;
    up[i] += step;
    down[i] -= step;
    gradient[i] = (function(up) - function(down)) / (2.0 * step);
  }
  return {function(p), 1.96 * std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)))};
}

std::optional<Estimate> if_known(const Estimate& estimate) {
  return estimate.half_width_95 < 0.5 * std::abs(estimate.value) ? std::optional(estimate) : std::nullopt;
}

}  // namespace

std::optional<MotionEstimates> fit_motion(const JointTrace& trace, const ToldJoint& told) {
  std::vector<Stretch> stretches = cut(trace, told, kLongWindow);
  if (stretches.size() < static_cast<std::size_t>(kLeastWindows)) return std::nullopt;
  const MotionModel model(trace, told);
  const Prior prior = prior_of(told);
  Fit fit(model, prior, std::move(stretches), search(model, prior));
  fit.run(kLongIterations);

  const MotionVector& p = fit.parameters();
  const Matrix covariance = fit.covariance();
  const auto of = [&](auto function) { return estimate_of(p, covariance, function); };
  const auto exp_of = [&](MotionParameter i, double factor) {
    return of([i, factor](const MotionVector& v) { return factor * std::exp(v[i]); });
  };
  const double K1 = told.spring.stiffness_1_Nm_rad;
  MotionEstimates found;
  found.total_inertia_kgm2 =
      of([](const MotionVector& v) { return std::exp(v[kLogMotorInertia]) + std::exp(v[kLogLinkInertia]); });
  if (!if_known(found.total_inertia_kgm2)) return std::nullopt;
  found.delay_s = of([](const MotionVector& v) { return v[kDelay] + std::exp(v[kLogLag]); });
  found.motor_inertia_kgm2 = if_known(exp_of(kLogMotorInertia, 1.0));
  found.link_inertia_kgm2 = if_known(exp_of(kLogLinkInertia, 1.0));
  found.stiffness_1_Nm_rad = if_known(exp_of(kLogStiffness, K1));
  found.damping_Nms_rad = if_known(exp_of(kLogDamping, 1.0));
  found.resonance_Hz = if_known(of([K1](const MotionVector& v) {
    return free_free_frequency_rad_s(std::exp(v[kLogMotorInertia]), std::exp(v[kLogLinkInertia]),
                                     K1 * std::exp(v[kLogStiffness])) /
           (2.0 * std::numbers::pi);
  }));
  found.antiresonance_Hz = if_known(of([K1](const MotionVector& v) {
    return std::sqrt(K1 * std::exp(v[kLogStiffness] - v[kLogLinkInertia])) / (2.0 * std::numbers::pi);
  }));
  found.gravity_Nm = of([](const MotionVector& v) { return std::hypot(v[kGravitySin], v[kGravityCos]); });
  // gs sin q + gc cos q = G sin(q - zero)
  found.gravity_zero_rad = std::atan2(-p[kGravityCos], p[kGravitySin]);
  found.kinematic_error_rad = {
      of([](const MotionVector& v) { return std::hypot(v[kError1Sin], v[kError1Cos]); }),
      of([](const MotionVector& v) { return std::hypot(v[kError2Sin], v[kError2Cos]); })};
  found.residual_rad = fit.residual_rad();
  found.windows = static_cast<int>(fit.windows());
  return found;
}

}  // namespace strainwave
