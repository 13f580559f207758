// SPDX-License-Identifier: BSD-3-Clause
// fit_motion() of identification.h: its starting points, its prior, and the estimates from the fitted parameters.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "commission/identification.h"
#include "commission/motion_spans.h"
#include "commission/window_fit.h"

namespace strainwave {

namespace {

// Samples of a stretch. Short stretches find the start, because a wrong resonance is not yet out of phase after 60 samples.
constexpr std::size_t kLongWindow = 400;
constexpr std::size_t kShortWindow = 60;
constexpr std::size_t kLeastWindow = 120;
constexpr int kShortIterations = 12;
constexpr int kLongIterations = 60;
constexpr std::size_t kSearchWindows = 24;
// Largest ratio of the residuals of long and short stretches. A wrong resonance gets out of phase and leaves many times more.
constexpr double kExplained = 3.0;
constexpr std::size_t kTries = 3;
// Factor on the intervals for errors that all strokes have in common, which their spread does not show. In commission_study 40 161, nine
// of ten links are within their intervals with this factor, and eight of ten with 1.3.
constexpr double kCommonErrors = 1.8;
// Largest half interval of a number that counts as found, as a share of it: 5 % for inertias and spring, 2 % for resonances. For damping
// it is half; a table is certified for a third (docs/commissioning.md).
constexpr double kKnownShare = 0.05;
constexpr double kKnownFrequencyShare = 0.02;
constexpr double kDampingShare = 0.5;
// Within the lost motion the spring is twice as stiff, so a wrong lost motion gives a wrong stiffness. The half interval is 27 % where
// both are wrong (commission_study 1 157), and at most 2 % for the joints 153 to 156, 158, 159 and 161.
constexpr double kLostMotionShare = 0.2;

std::vector<MotionWindow> cut(const JointTrace& trace, const ToldJoint& told, std::size_t length) {
  std::vector<MotionWindow> windows;
  std::size_t stroke = 0;
  for (const MotionSpan& span : sliding_spans(trace, told.gear_ratio, std::min(length, kLeastWindow))) {
    if (!windows.empty() && windows.back().direction != span.direction) ++stroke;
    const std::size_t pieces = std::max<std::size_t>(1, (span.count + length / 2) / length);
    for (std::size_t i = 0; i < pieces; ++i) {
      const std::size_t first = span.first + i * span.count / pieces;
      const std::size_t end = span.first + (i + 1) * span.count / pieces;
      MotionWindow window{first, end - first, span.direction, speed_around(trace, first), 0.0, stroke};
      double torque = 0.0;
      for (std::size_t k = first; k < end; ++k) torque += trace.samples[k].torque_ordered_Nm;
      window.friction_Nm = span.direction * torque / static_cast<double>(window.count);
      windows.push_back(window);
    }
  }
  return windows;
}

MotionPrior prior_of(const ToldJoint& told) {
  MotionPrior prior;
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
  // Weak prior for the weight of the link: twice the torque at the spring's second corner.
  set(kGravitySin, 0.0, 2.0 * told.spring.torque_2_Nm);
  set(kGravityCos, 0.0, 2.0 * told.spring.torque_2_Nm);
  for (const MotionParameter error : {kError1Sin, kError1Cos, kError2Sin, kError2Cos}) set(error, 0.0, 3e-4);
  return prior;
}

/// A starting point of a fit.
struct Start {
  double cost = 0.0;
  double residual_rad = 0.0;  ///< over short stretches
  MotionVector parameters;
};

/// Starting points, best first, from short stretches, which a wrong resonance does not put out of phase.
std::vector<Start> starts(const MotionModel& model, const MotionPrior& prior) {
  std::vector<MotionWindow> all = cut(model.trace(), model.told(), kShortWindow);
  std::vector<MotionWindow> few;
  const std::size_t stride = std::max<std::size_t>(1, all.size() / kSearchWindows);
  for (std::size_t i = 0; i < all.size(); i += stride) few.push_back(all[i]);
  std::vector<Start> found;
  for (const double motor : {1.0, 1.8, 3.2})
    for (const double link : {0.2, 0.8, 3.0}) {
      MotionVector start = prior.mean;
      start[kLogMotorInertia] = std::log(motor * model.told().motor_inertia_kgm2);
      start[kLogLinkInertia] = start[kLogMotorInertia] + std::log(link);
      WindowFit fit(model, prior, few, start);
      fit.run(kShortIterations);
      if (std::isfinite(fit.cost())) found.push_back({fit.cost(), fit.residual_rad(), fit.parameters()});
    }
  std::sort(found.begin(), found.end(), [](const Start& a, const Start& b) { return a.cost < b.cost; });
  // Short stretches cannot separate these parameters from a stretch's own friction, whose first guess is the whole torque.
  for (Start& start : found)
    for (const MotionParameter slow : {kViscous, kGravitySin, kGravityCos})
      start.parameters[slow] = prior.mean[slow];
  return found;
}

/// The fit from the best starting point for long stretches; nothing if none explains them about as well as short ones.
std::optional<WindowFit> fit_windows(const MotionModel& model, const std::vector<MotionWindow>& windows) {
  const MotionPrior prior = prior_of(model.told());
  const std::vector<Start> all = starts(model, prior);
  std::optional<WindowFit> best;
  for (std::size_t i = 0; i < std::min(kTries, all.size()); ++i) {
    WindowFit fit(model, prior, windows, all[i].parameters);
    if (fit.run(kLongIterations) && std::isfinite(fit.cost()) && (!best || fit.cost() < best->cost()))
      best.emplace(fit);
  }
  if (!best || best->residual_rad() > kExplained * all.front().residual_rad) return std::nullopt;
  return best;
}

/// The 97.5 % quantile of Student's distribution (Abramowitz and Stegun, 26.7.5).
double student_975(double degrees) {
  return 1.96 + 2.372 / degrees + 2.82 / (degrees * degrees);
}

/// Value of a function of the parameters, with half its 95 % interval from its gradient.
template <typename Function>
IntervalEstimate estimate_of(const MotionVector& p, const WindowFit::Covariance& covariance,
                             double deviations, Function function) {
  MotionVector gradient;
  for (Eigen::Index i = 0; i < kMotionParameters; ++i) {
    const double step = std::max(1e-7, 1e-5 * std::abs(p[i]));
    MotionVector up = p;
    MotionVector down = p;
    up[i] += step;
    down[i] -= step;
    gradient[i] = (function(up) - function(down)) / (2.0 * step);
  }
  return {function(p), deviations * std::sqrt(std::max(0.0, gradient.dot(covariance * gradient)))};
}

/// Nothing if half the interval is more than `share` of the number.
std::optional<IntervalEstimate> if_known(const IntervalEstimate& estimate, double share) {
  return estimate.half_width_95 < share * std::abs(estimate.value) ? std::optional(estimate) : std::nullopt;
}

}  // namespace

std::optional<MotionEstimates> fit_motion(const JointTrace& trace, const ToldJoint& told) {
  const std::vector<MotionWindow> windows = cut(trace, told, kLongWindow);
  if (windows.size() < static_cast<std::size_t>(kLeastWindows)) return std::nullopt;
  const MotionModel model(trace, told);
  const std::optional<WindowFit> fit = fit_windows(model, windows);
  if (!fit) return std::nullopt;

  const MotionVector& p = fit->parameters();
  const WindowFit::Covariance covariance = fit->covariance();
  const double deviations = kCommonErrors * student_975(std::max(1.0, fit->strokes() - 1.0));
  const auto of = [&](auto function) { return estimate_of(p, covariance, deviations, function); };
  const auto exp_of = [&](MotionParameter i, double factor) {
    return of([i, factor](const MotionVector& v) { return factor * std::exp(v[i]); });
  };
  const double K1 = told.spring.stiffness_1_Nm_rad;
  MotionEstimates found;
  found.total_inertia_kgm2 =
      of([](const MotionVector& v) { return std::exp(v[kLogMotorInertia]) + std::exp(v[kLogLinkInertia]); });
  if (!if_known(found.total_inertia_kgm2, kKnownShare)) return std::nullopt;
  found.delay_s = of([](const MotionVector& v) { return v[kDelay] + std::exp(v[kLogLag]); });
  found.motor_inertia_kgm2 = if_known(exp_of(kLogMotorInertia, 1.0), kKnownShare);
  found.link_inertia_kgm2 = if_known(exp_of(kLogLinkInertia, 1.0), kKnownShare);
  // If the link does not show, the fit may attribute its inertia to the motor.
  if (!found.link_inertia_kgm2) found.motor_inertia_kgm2.reset();
  if (if_known(exp_of(kLogLostMotion, 1.0), kLostMotionShare))
    found.stiffness_1_Nm_rad = if_known(exp_of(kLogStiffness, K1), kKnownShare);
  found.damping_Nms_rad = if_known(exp_of(kLogDamping, 1.0), kDampingShare);
  const auto resonance = [K1](const MotionVector& v) {
    return free_free_frequency_rad_s(std::exp(v[kLogMotorInertia]), std::exp(v[kLogLinkInertia]),
                                     K1 * std::exp(v[kLogStiffness])) /
           (2.0 * std::numbers::pi);
  };
  const auto antiresonance = [K1](const MotionVector& v) {
    return std::sqrt(K1 * std::exp(v[kLogStiffness] - v[kLogLinkInertia])) / (2.0 * std::numbers::pi);
  };
  // The resonances follow from these three numbers.
  if (found.motor_inertia_kgm2 && found.link_inertia_kgm2 && found.stiffness_1_Nm_rad) {
    found.resonance_Hz = if_known(of(resonance), kKnownFrequencyShare);
    found.antiresonance_Hz = if_known(of(antiresonance), kKnownFrequencyShare);
  }
  found.gravity_Nm = of([](const MotionVector& v) { return std::hypot(v[kGravitySin], v[kGravityCos]); });
  // gs sin q + gc cos q = G sin(q - zero)
  found.gravity_zero_rad = std::atan2(-p[kGravityCos], p[kGravitySin]);
  found.kinematic_error_rad = {
      of([](const MotionVector& v) { return std::hypot(v[kError1Sin], v[kError1Cos]); }),
      of([](const MotionVector& v) { return std::hypot(v[kError2Sin], v[kError2Cos]); })};
  found.residual_rad = fit->residual_rad();
  found.windows = static_cast<int>(windows.size());
  return found;
}

}  // namespace strainwave
