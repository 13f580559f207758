// SPDX-License-Identifier: BSD-3-Clause
#include "control/joint/inertia_estimate.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace strainwave {

namespace {

// Least movement in counts over the span of a mean: its direction is then certain, and its velocity known to a tenth.
constexpr double kLeastCounts = 6.0;
// Weight of each window relative to the next one: a memory of 0.67 s of motion.
constexpr double kKept = 0.97;
// Least error of a window, as a share of static friction times the window's length: load-dependent friction, ripple and swings.
constexpr double kNoiseShare = 0.1;
// Least static friction that scales the errors, for tables without friction.
constexpr double kLeastScale_Nm = 1e-3;
// Prior standard deviation of k. That of the unknown load is static friction.
constexpr double kFrictionDeviation = 0.3;
// Least count of windows: four, weighted by kKept.
constexpr double kLeastWindows = 3.8;

// Lengths of means and windows. Loops with a period below kFastest_s get shorter ones.
constexpr double kSpan_s = 0.004;
constexpr double kWindow_s = 0.02;
constexpr double kFastest_s = 1e-4;

int periods_of(double duration_s, double period_s, int least) noexcept {
  return std::max(least, static_cast<int>(std::lround(duration_s / std::max(period_s, kFastest_s))));
}

}  // namespace

InertiaEstimate::InertiaEstimate(const InertiaEstimateConfig& config) noexcept
    : config_(config),
      span_(periods_of(kSpan_s, config.period_s, 2)),
      window_(periods_of(kWindow_s, config.period_s, 5)) {
  static_assert(kRoom > (kSpan_s + kWindow_s) / kFastest_s + kMaxControlDelay);
}

const InertiaEstimate::Sums& InertiaEstimate::sums(int periods_ago) const noexcept {
  return sums_[(now_ - static_cast<unsigned>(periods_ago)) % kRoom];
}

InertiaEstimate::Means InertiaEstimate::means(int periods_ago) const noexcept {
  Means mean;
  mean.velocity_rad_s =
      (sums(periods_ago).position_rad - sums(periods_ago + span_).position_rad) / (span_ * config_.period_s);
  // Trapezoidal rule: the sums are linear between samples, since the torque is held.
  for (int k = 0; k <= span_; ++k) {
    const double share = (k == 0 || k == span_ ? 0.5 : 1.0) / span_;
    mean.impulse_Nms += share * sums(periods_ago + k).impulse_Nms;
    mean.friction_Nms += share * sums(periods_ago + k).friction_Nms;
  }
  return mean;
}

void InertiaEstimate::step(const Sample& sample, const JointModel& model) noexcept {
  ++now_;
  torque_Nm_[now_ % kRoom] = sample.torque_Nm - sample.known_load_Nm;
  const double acting_Nm = torque_Nm_[(now_ - static_cast<unsigned>(config_.delay_periods)) % kRoom];
  const Sums& before = sums(1);
  const bool anew = samples_ == 0;
  Sums& next = sums_[now_ % kRoom];
  next.position_rad = sample.position_rad;
  next.impulse_Nms = anew ? 0.0 : before.impulse_Nms + acting_Nm * config_.period_s;
  next.friction_Nms = anew ? 0.0 : before.friction_Nms;
  samples_ = std::min(samples_ + 1, static_cast<int>(kRoom));
  if (samples_ <= std::max(span_, config_.delay_periods)) return;

  const double travel_rad = next.position_rad - sums(span_).position_rad;
  const int way =
      std::abs(travel_rad) < kLeastCounts * config_.count_rad ? 0 : static_cast<int>(sign(travel_rad));
  next.friction_Nms += way * model.friction_Nm(travel_rad / (span_ * config_.period_s)) * config_.period_s;
  moving_ = way == 0 || way != way_ ? 0 : moving_ + 1;
  way_ = way;
  if (moving_ < span_ + window_) return;
  learn(std::max(model.friction.static_Nm, kLeastScale_Nm));
  // The next window begins with the mean that ends this one.
  moving_ = span_;
}

void InertiaEstimate::learn(double friction_scale_Nm) noexcept {
  const Means end = means(0);
  const Means begin = means(window_);
  const double noise_Nms = kNoiseShare * friction_scale_Nm * window_ * config_.period_s;
  const Eigen::Vector3d by =
      Eigen::Vector3d(end.velocity_rad_s - begin.velocity_rad_s, end.friction_Nms - begin.friction_Nms,
                      friction_scale_Nm * window_ * config_.period_s) /
      noise_Nms;
  const double shown = (end.impulse_Nms - begin.impulse_Nms) / noise_Nms;
  normal_ = kKept * normal_ + by * by.transpose();
  right_ = kKept * right_ + by * shown;
  const Eigen::Vector3d before(0.0, 1.0 / square(kFrictionDeviation), 1.0);
  Eigen::Matrix3d information = normal_;
  information.diagonal() += before;
  Eigen::Vector3d wanted = right_;
  wanted(1) += before(1);
  const Eigen::Matrix3d covariance = information.inverse();
  const Eigen::Vector3d fitted = covariance * wanted;
  const double left = shown - by.dot(fitted);
  squares_ = kKept * squares_ + left * left;
  windows_ = kKept * windows_ + 1.0;
  inertia_kgm2_ = fitted(0);
  deviation_kgm2_ = std::sqrt(std::max(0.0, covariance(0, 0)) * std::max(1.0, squares_ / windows_));
}

std::optional<double> InertiaEstimate::inertia_kgm2() const noexcept {
  if (windows_ < kLeastWindows || !(deviation_kgm2_ <= kKnown * inertia_kgm2_)) return {};
  return inertia_kgm2_;
}

void InertiaEstimate::forget() noexcept {
  interrupt();
  normal_.setZero();
  right_.setZero();
  squares_ = windows_ = inertia_kgm2_ = deviation_kgm2_ = 0.0;
}

}  // namespace strainwave
