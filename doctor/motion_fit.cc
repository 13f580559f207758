// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/motion_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <utility>

#include "doctor/motion_windows.h"

namespace strainwave {

namespace {

constexpr double kNoise_Nm = 0.3;       // of a window; weights the measurement against the priors
constexpr double kScaleNoise_Nm = 0.6;  // likewise, for the spring
constexpr double kSplitPrior = 1.0;     // of the difference of Jm and Jl, each over the configured
constexpr double kScalePrior = 0.5;     // standard deviation of ln(scale)
constexpr double kCoarse = 0.1, kFine = 0.02;
constexpr int kPasses = 2;
constexpr double kImpossible = 1e12;     // N2.m2, above the squared residuals of any motion
constexpr double kMostError_rad = 5e-4;  // limit of each part of a gear's error
constexpr int kParameters = kMotionColumns;
using Rows = MotionRows;
using Normal = Eigen::Matrix<double, kParameters, kParameters>;
using Solution = Eigen::Matrix<double, kParameters, 1>;

double quantile(const Eigen::VectorXd& values, double share) {
  std::vector<double> sorted(values.begin(), values.end());
  const auto at = sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size()));
  std::nth_element(sorted.begin(), at, sorted.end());
  return *at;
}

class Regression {
 public:
  explicit Regression(const Evidence& evidence)
      : evidence_(evidence), windows_(evidence), weights_(Eigen::VectorXd::Ones(windows_.count())) {}

  std::optional<MotionFit> run() {
    if (windows_.count() < kLeastMotionWindows) return std::nullopt;
    for (int d = 0; d <= 2 * MotionWindows::kMostDelay; ++d) torques_.push_back(windows_.torques(0.5 * d));
    const bool flexible = windows_.flexible();
    // A resonance with 2 % damping is a fiftieth of its frequency wide, so a fine grid follows the coarse one.
    for (int i = 0; i < (flexible ? kPasses : 1); ++i) {
      use_scales(flexible ? 18 : 0, kCoarse, 1.0);
      search();
      reweigh();
      search();
      if (flexible) assume_what_is_found();
    }
    if (flexible) use_scales(5, kFine, scales_[best_scale_]);
    search();
    return result(flexible);
  }

 private:
  void assume_what_is_found() {
    const Solved solved = solve(best_scale_, best_delay_, inverse_normal(best_scale_));
    const Solution& found = solved.parameters;
    AssumedLink link = windows_.assumed();
    if (found[kLink] <= 0.0) return;
    for (std::size_t i = 0; i < link.error_rad.size(); ++i) {
      const double more_rad =
          found[kError + static_cast<int>(i)] / found[kLink] * MotionWindows::kErrorUnit_rad;
      link.error_rad[i] = std::clamp(link.error_rad[i] + more_rad, -kMostError_rad, kMostError_rad);
    }
    link.bias_Nm = found[kBias];
    link.sine_Nm = found[kSine];
    link.cosine_Nm = found[kCosine];
    windows_.assume(link);
  }

  /// Uses 2 count + 1 scales around `middle`, with equal ratios.
  void use_scales(int count, double step, double middle) {
    scales_.clear();
    rows_.clear();
    for (int i = -count; i <= count; ++i) {
      scales_.push_back(middle * std::exp(step * i));
      rows_.push_back(windows_.rows(scales_.back()));
    }
  }

  // Standard deviations of weak priors around 0: parameters that the motion does not show stay small.
  Solution priors() const {
    const double limit_Nm = evidence_.torque_limit_Nm();
    Solution prior;
    const double error = evidence_.told.link ? 3.0 * evidence_.told.link->link_inertia_kgm2 : 1e-6;
    prior << 1e3, 1e3, 0.3 * limit_Nm, 0.1 * limit_Nm, 0.01 * limit_Nm, 0.3 * limit_Nm, 0.3 * limit_Nm, error,
        error, error, error;
    return prior;
  }

  struct Solved {
    double squares = 0.0;
    Solution parameters;
    Normal inverse;
  };
  Normal inverse_normal(std::size_t scale) const {
    Normal normal = rows_[scale].transpose() * weights_.asDiagonal() * rows_[scale];
    const Solution prior = priors();
    for (int i = 0; i < kParameters; ++i) normal(i, i) += std::pow(kNoise_Nm / prior[i], 2);
    if (evidence_.told.link) {
      Solution split = Solution::Zero();
      split[kMotor] = 1.0 / evidence_.told.link->motor_inertia_kgm2;
      split[kLink] = -1.0 / evidence_.told.link->link_inertia_kgm2;
      normal += std::pow(kNoise_Nm / kSplitPrior, 2) * split * split.transpose();
    }
    return normal.inverse();
  }
  /// Changes the solution to the one in which parameter `i` is 0.
  static void leave_out(int i, Solved& solved) {
    const Solution column = solved.inverse.col(i) / solved.inverse(i, i);
    solved.parameters -= solved.parameters[i] * column;
    solved.inverse -= solved.inverse(i, i) * column * column.transpose();
  }
  Solved solve(std::size_t scale, std::size_t delay, const Normal& inverse) const {
    const Solution right = rows_[scale].transpose() * weights_.cwiseProduct(torques_[delay]);
    Solved solved{0.0, inverse * right, inverse};
    // In a swing, viscous friction of the wrong sign looks like a shorter delay.
    const double inertia_kgm2 = solved.parameters[kMotor] + solved.parameters[kLink];
    if (solved.parameters[kViscous] * inertia_kgm2 < 0.0) leave_out(kViscous, solved);
    const Eigen::VectorXd left = torques_[delay] - rows_[scale] * solved.parameters;
    solved.squares = left.cwiseAbs2().dot(weights_);
    return solved;
  }

  static double prior_squares(double scale) {
    return std::pow(kScaleNoise_Nm * std::log(scale) / kScalePrior, 2);
  }

  void search() {
    best_scale_ = best_delay_ = 0;
    squares_.assign(scales_.size(), std::vector<double>(torques_.size()));
    for (std::size_t s = 0; s < scales_.size(); ++s) {
      const Normal inverse = inverse_normal(s);
      for (std::size_t d = 0; d < torques_.size(); ++d) {
        const Solved solved = solve(s, d, inverse);
        squares_[s][d] = solved.squares + prior_squares(scales_[s]);
        // Shifted by half a period of the oscillation, an oscillating torque fits a negative inertia.
        if (evidence_.chattered() && solved.parameters[kMotor] + solved.parameters[kLink] <= 0.0)
          squares_[s][d] = kImpossible;
        if (squares_[s][d] >= squares_[best_scale_][best_delay_]) continue;
        best_scale_ = s;
        best_delay_ = d;
      }
    }
  }

  void reweigh() {
    const Solved solved = solve(best_scale_, best_delay_, inverse_normal(best_scale_));
    const Eigen::VectorXd left = (torques_[best_delay_] - rows_[best_scale_] * solved.parameters).cwiseAbs();
    const double bound = 3.0 * std::max(1.4826 * quantile(left, 0.5), 1e-4);
    for (Eigen::Index i = 0; i < left.size(); ++i) weights_[i] = std::min(1.0, bound / left[i]);
  }

  /// The lowest point of a parabola through three neighbours, and the deviation that its curvature gives.
  static MotionEstimate refined(double before, double at, double after, double step, double noise_squares) {
    const double curvature = std::max(before - 2.0 * at + after, 1e-12);
    const double offset = std::clamp(0.5 * (before - after) / curvature, -1.0, 1.0);
    return {offset * step, step * std::sqrt(2.0 * noise_squares / curvature)};
  }

  MotionFit result(bool flexible) {
    const Solved solved = solve(best_scale_, best_delay_, inverse_normal(best_scale_));
    constexpr double kOverlap = 16.0;  // windows share samples, and the model's errors are not white
    const double count = std::max(1.0, weights_.sum() - kParameters);
    const double noise_squares = kOverlap * solved.squares / count;
    MotionFit fit;
    fit.windows = windows_.count();
    fit.acceleration_rad_s2 = quantile(rows_[best_scale_].col(kMotor).cwiseAbs(), 0.9);
    fit.remainder_Nm = std::sqrt(solved.squares / count);
    const auto estimate = [&](int i) {
      return MotionEstimate{solved.parameters[i], std::sqrt(noise_squares * solved.inverse(i, i))};
    };
    fit.coulomb_Nm = estimate(kCoulomb);
    fit.viscous_Nms_rad = estimate(kViscous);
    Solution both = Solution::Zero();
    both[kMotor] = 1.0;
    both[kLink] = flexible ? 1.0 : 0.0;
    fit.inertia_kgm2 = {both.dot(solved.parameters),
                        std::sqrt(noise_squares * both.dot(solved.inverse * both))};
    fit.delay_periods = delay_estimate(noise_squares);
    if (flexible) fit.stiffness_scale = stiffness_estimate(solved, noise_squares);
    find_load(solved, noise_squares, fit);
    return fit;
  }

  MotionEstimate delay_estimate(double noise_squares) const {
    const auto& row = squares_[best_scale_];
    const std::size_t d = std::clamp<std::size_t>(best_delay_, 1, row.size() - 2);
    MotionEstimate estimate = refined(row[d - 1], row[d], row[d + 1], 0.5, noise_squares);
    estimate.value += 0.5 * static_cast<double>(d);
    return estimate;
  }

  // The grid's scale applies to K / Jl. The scale of K follows from the estimated inertia of the link.
  std::optional<MotionEstimate> stiffness_estimate(const Solved& solved, double noise_squares) const {
    if (solved.parameters[kLink] <= 0.0) return std::nullopt;
    const std::size_t s = std::clamp<std::size_t>(best_scale_, 1, scales_.size() - 2);
    const auto at = [&](std::size_t i) { return squares_[i][best_delay_]; };
    MotionEstimate step = refined(at(s - 1), at(s), at(s + 1), kFine, noise_squares);
    // The deviation leaves out the prior, so that it reflects only what the motion shows.
    const auto shown = [&](std::size_t i) { return at(i) - prior_squares(scales_[i]); };
    step.deviation = refined(shown(s - 1), shown(s), shown(s + 1), kFine, noise_squares).deviation;
    const double scale =
        scales_[s] * std::exp(step.value) * solved.parameters[kLink] / evidence_.told.link->link_inertia_kgm2;
    const double link_share =
        std::sqrt(noise_squares * solved.inverse(kLink, kLink)) / solved.parameters[kLink];
    return MotionEstimate{scale, scale * std::hypot(step.deviation, link_share)};
  }

  void find_load(const Solved& solved, double noise_squares, MotionFit& fit) const {
    const GravityLoad told = evidence_.told.gravity.value_or(GravityLoad{});
    for (const double at_rad : windows_.positions_rad()) {
      Solution row = Solution::Zero();
      row[kBias] = 1.0;
      row[kSine] = std::sin(at_rad);
      row[kCosine] = std::cos(at_rad);
      const double load_Nm = row.dot(solved.parameters) - told.at(at_rad);
      if (std::abs(load_Nm) <= std::abs(fit.load_Nm)) continue;
      fit.load_Nm = load_Nm;
      fit.load_at_rad = at_rad;
      fit.load_deviation_Nm = std::sqrt(noise_squares * row.dot(solved.inverse * row));
    }
  }

  const Evidence& evidence_;
  MotionWindows windows_;
  Eigen::VectorXd weights_;
  std::vector<double> scales_;
  std::vector<Rows> rows_;                ///< by scale
  std::vector<Eigen::VectorXd> torques_;  ///< by delay, half periods
  std::vector<std::vector<double>> squares_;
  std::size_t best_scale_ = 0, best_delay_ = 0;
};

}  // namespace

std::optional<MotionFit> fit_motion(const Evidence& evidence) {
  return Regression(evidence).run();
}

}  // namespace strainwave
