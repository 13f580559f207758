// SPDX-License-Identifier: BSD-3-Clause
#include "commission/window_fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace strainwave {

namespace {

constexpr Eigen::Index kLag = 3;
// A step of the parameters changes a logarithm by at most this.
constexpr double kMostChange = 0.7;
// Steps of a stretch's own parameters before the first common step. A stretch may begin in a swing, far from the first guess.
constexpr int kSettlingSteps = 6;
// A step that changes the cost by less than this share ends the fit.
constexpr double kConverged = 1e-5;

/// Steps of the difference quotients for a stretch's own parameters, in the order of WindowVector.
WindowVector own_steps() {
  return (WindowVector() << 1e-6, 1e-4, 1e-6, 1e-4, 1e-3).finished();
}

bool is_logarithm(Eigen::Index i) {
  return i <= kLogDamping || i == kLogLag || i == kLogLostMotion;
}

double parameter_step(Eigen::Index i) {
  if (i == kDelay) return 1e-6;
  if (i >= kError1Sin) return 1e-7;
  return i == kViscous || i == kGravitySin || i == kGravityCos ? 1e-3 : 1e-4;
}

}  // namespace

WindowFit::WindowFit(const MotionModel& model, const MotionPrior& prior,
                     const std::vector<MotionWindow>& windows, const MotionVector& start)
    : model_(model), prior_(prior), parameters_(start) {
  stretches_.resize(windows.size());
  for (std::size_t i = 0; i < windows.size(); ++i) stretches_[i].window = windows[i];
  model_.keep_in_bounds(parameters_);
}

bool WindowFit::run(int iterations) {
  for (Stretch& stretch : stretches_) settle(stretch);
  linearise();
  double damping = 1e-3;
  for (int i = 0; i < iterations; ++i) {
    const double before = cost_;
    const MotionVector kept = parameters_;
    std::vector<WindowVector> kept_own;
    for (const Stretch& stretch : stretches_) kept_own.push_back(stretch.own);
    Covariance damped = normal_;
    damped.diagonal() += damping * normal_.diagonal();
    MotionVector change = damped.ldlt().solve(right_);
    for (Eigen::Index k = 0; k < kMotionParameters; ++k)
      if (is_logarithm(k)) change[k] = std::clamp(change[k], -kMostChange, kMostChange);
    parameters_ += change;
    model_.keep_in_bounds(parameters_);
    const MotionVector moved = parameters_ - kept;
    for (Stretch& s : stretches_) {
      OwnNormal own = s.own_normal;
      own.diagonal() *= 1.0 + damping;
      s.own += own.ldlt().solve(s.own_right - s.cross * moved);
    }
    const double cost = present_cost();
    if (cost < before) {
      damping = std::max(1e-7, damping * 0.2);
      linearise();
      if (before - cost_ < kConverged * before) return true;
    } else {
      parameters_ = kept;
      for (std::size_t k = 0; k < stretches_.size(); ++k) stretches_[k].own = kept_own[k];
      if (cost - before < kConverged * before) return true;
      damping *= 10.0;
      if (damping > 1e4) return false;
    }
  }
  return false;
}

double WindowFit::residual_rad() const {
  return std::sqrt(squares_ / std::max(1.0, count_));
}

int WindowFit::strokes() const {
  int count = 0;
  for (std::size_t i = 0; i < stretches_.size(); ++i)
    if (i == 0 || stretches_[i].window.stroke != stretches_[i - 1].window.stroke) ++count;
  return count;
}

WindowFit::Covariance WindowFit::covariance() const {
  Covariance spread = Covariance::Zero();
  for (std::size_t i = 0; i < stretches_.size();) {
    Covariance others = normal_;
    MotionVector score = MotionVector::Zero();
    for (const std::size_t stroke = stretches_[i].window.stroke;
         i < stretches_.size() && stretches_[i].window.stroke == stroke; ++i) {
      others -= stretches_[i].normal;
      score += stretches_[i].score;
    }
    const MotionVector change = others.ldlt().solve(score);
    spread += change * change.transpose();
  }
  // The prior has its own share.
  Covariance before = Covariance::Zero();
  const double variance = noise_variance();
  for (Eigen::Index i = 0; i < kMotionParameters; ++i)
    if (prior_.deviation[i] > 0.0) before(i, i) = std::pow(variance / prior_.deviation[i], 2);
  const Covariance inverse = normal_.ldlt().solve(Covariance::Identity());
  const auto n = static_cast<double>(strokes());
  return (n - 1.0) / n * spread + inverse * before * inverse.transpose();
}

Eigen::VectorXd WindowFit::residuals(const Stretch& stretch, const MotionVector& parameters,
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

double WindowFit::noise_variance() const {
  return std::max(squares_ / std::max(1.0, count_), 1e-16);
}

double WindowFit::prior_cost() const {
  double cost = 0.0;
  for (Eigen::Index i = 0; i < kMotionParameters; ++i)
    if (prior_.deviation[i] > 0.0)
      cost += std::pow((parameters_[i] - prior_.mean[i]) / prior_.deviation[i], 2);
  return cost * prior_variance_;
}

double WindowFit::present_cost() const {
  double squares = 0.0;
  for (const Stretch& stretch : stretches_)
    squares += residuals(stretch, parameters_, stretch.own).squaredNorm();
  return std::isfinite(squares) ? squares + prior_cost() : std::numeric_limits<double>::infinity();
}

void WindowFit::linearise() {
  normal_.setZero();
  right_.setZero();
  squares_ = count_ = 0.0;
  for (Stretch& stretch : stretches_) linearise(stretch);
  prior_variance_ = noise_variance();
  for (Eigen::Index i = 0; i < kMotionParameters; ++i) {
    if (prior_.deviation[i] <= 0.0) continue;
    const double weight = prior_variance_ / (prior_.deviation[i] * prior_.deviation[i]);
    normal_(i, i) += weight;
    right_[i] -= weight * (parameters_[i] - prior_.mean[i]);
  }
  cost_ = squares_ + prior_cost();
}

WindowFit::OwnSlopes WindowFit::own_slopes(const Stretch& s, const Eigen::VectorXd& r) const {
  const WindowVector own_step = own_steps();
  OwnSlopes L(r.size(), kWindowParameters);
  for (Eigen::Index i = 0; i < kWindowParameters; ++i) {
    WindowVector own = s.own;
    own[i] += own_step[i];
    L.col(i) = (r - residuals(s, parameters_, own)) / own_step[i];
  }
  return L;
}

void WindowFit::settle(Stretch& s) {
  double damping = 1e-3;
  Eigen::VectorXd r = residuals(s, parameters_, s.own);
  for (int i = 0; i < kSettlingSteps; ++i) {
    const OwnSlopes L = own_slopes(s, r);
    OwnNormal normal = L.transpose() * L;
    normal.diagonal() *= 1.0 + damping;
    normal(0, 0) += 1.0;
    const WindowVector own = s.own + normal.ldlt().solve(L.transpose() * r);
    const Eigen::VectorXd left = residuals(s, parameters_, own);
    const bool better = left.squaredNorm() < r.squaredNorm();
    damping *= better ? 0.2 : 10.0;
    if (!better) continue;
    s.own = own;
    r = left;
  }
}

void WindowFit::linearise(Stretch& s) {
  const Eigen::VectorXd r = residuals(s, parameters_, s.own);
  Eigen::Matrix<double, Eigen::Dynamic, kMotionParameters> J(r.size(), kMotionParameters);
  for (Eigen::Index i = 0; i < kMotionParameters; ++i) {
    MotionVector p = parameters_;
    p[i] += parameter_step(i);
    J.col(i) = (r - residuals(s, p, s.own)) / parameter_step(i);
  }
  const OwnSlopes L = own_slopes(s, r);
  s.own_normal = L.transpose() * L;
  s.own_normal.diagonal() *= 1.0 + 1e-9;
  // The initial position has no effect on differences. This term keeps it unchanged.
  s.own_normal(0, 0) += 1.0;
  s.own_right = L.transpose() * r;
  s.cross = L.transpose() * J;
  const Eigen::LDLT<OwnNormal> own = s.own_normal.ldlt();
  s.score = J.transpose() * r - s.cross.transpose() * own.solve(s.own_right);
  s.normal = J.transpose() * J - s.cross.transpose() * own.solve(s.cross);
  normal_ += s.normal;
  right_ += s.score;
  squares_ += r.squaredNorm();
  count_ += static_cast<double>(r.size());
}

}  // namespace strainwave
