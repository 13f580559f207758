// SPDX-License-Identifier: BSD-3-Clause
#include "design/friction/steady_speed.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

namespace strainwave {

namespace {

constexpr double kSameSpeed = 1e-9;    // relative: the shaper holds a speed exactly
constexpr double kLongestGap_s = 0.1;  // covers lost messages; a longer gap begins another run

using Run = std::span<const MotionSample>;

bool continues(const MotionSample& before, const MotionSample& sample) {
  const double change = std::abs(sample.setpoint_velocity_rad_s - before.setpoint_velocity_rad_s);
  return sample.tracking && sample.time_s - before.time_s <= kLongestGap_s &&
         change <= kSameSpeed * std::abs(before.setpoint_velocity_rad_s);
}

/// Stretches of constant setpoint velocity other than 0. A single sample is only a value on a ramp.
std::vector<Run> constant_runs(const std::vector<MotionSample>& samples) {
  std::vector<Run> runs;
  for (std::size_t begin = 0; begin < samples.size();) {
    std::size_t end = begin + 1;
    while (end < samples.size() && continues(samples[end - 1], samples[end])) ++end;
    const bool moves = samples[begin].tracking && samples[begin].setpoint_velocity_rad_s != 0.0;
    if (moves && end - begin >= 2) runs.emplace_back(&samples[begin], end - begin);
    begin = end;
  }
  return runs;
}

Run settled(Run run, const SteadyCriteria& criteria) {
  const double length_s = run.back().time_s - run.front().time_s;
  const double from_s = run.front().time_s + std::max(criteria.settle_s, criteria.settle_share * length_s);
  const auto first =
      std::find_if(run.begin(), run.end(), [&](const MotionSample& s) { return s.time_s >= from_s; });
  return run.subspan(static_cast<std::size_t>(first - run.begin()));
}

/// The least-squares line of position over time: its slope, and the deviation from it.
struct Line {
  double slope_rad_s = 0.0;
  double deviation_rad = 0.0;
};
Line fit_line(Run run) {
  const double n = static_cast<double>(run.size());
  double t = 0.0, x = 0.0;
  for (const MotionSample& s : run) {
    t += s.time_s / n;
    x += s.joint_position_rad / n;
  }
  double tt = 0.0, tx = 0.0, xx = 0.0;
  for (const MotionSample& s : run) {
    tt += (s.time_s - t) * (s.time_s - t);
    tx += (s.time_s - t) * (s.joint_position_rad - x);
    xx += (s.joint_position_rad - x) * (s.joint_position_rad - x);
  }
  return {tx / tt, std::sqrt(std::max(0.0, xx - tx * tx / tt) / n)};
}

double mean_torque_Nm(Run run) {
  double sum = 0.0;
  for (const MotionSample& s : run) sum += s.torque_applied_Nm;
  return sum / static_cast<double>(run.size());
}

double velocity_deviation_rad_s(Run run) {
  const double n = static_cast<double>(run.size());
  double mean = 0.0, squares = 0.0;
  for (const MotionSample& s : run) mean += s.joint_velocity_rad_s / n;
  for (const MotionSample& s : run)
    squares += (s.joint_velocity_rad_s - mean) * (s.joint_velocity_rad_s - mean);
  return std::sqrt(squares / n);
}

bool is_steady(Run run, double inertia_kgm2, const SteadyCriteria& criteria) {
  const double wanted = run.front().setpoint_velocity_rad_s;
  const Line line = fit_line(run);
  if (std::abs(line.slope_rad_s - wanted) > criteria.speed_tolerance * std::abs(wanted)) return false;
  const double travelled = std::abs(run.back().joint_position_rad - run.front().joint_position_rad);
  if (line.deviation_rad > criteria.ripple_tolerance * travelled) return false;
  if (velocity_deviation_rad_s(run) > criteria.velocity_tolerance * std::abs(wanted)) return false;
  const std::size_t half = run.size() / 2;
  const double change = fit_line(run.subspan(half)).slope_rad_s - fit_line(run.first(half)).slope_rad_s;
  const double half_s = 0.5 * (run.back().time_s - run.front().time_s);
  return std::abs(inertia_kgm2 * change / half_s) <=
         criteria.inertia_tolerance * std::abs(mean_torque_Nm(run));
}

/// The range between two positions.
struct Stretch {
  double low_rad = 0.0;
  double high_rad = 0.0;
  double length_rad() const { return high_rad - low_rad; }
};
Stretch stretch_of(Run run) {
  const auto [low, high] = std::minmax(run.front().joint_position_rad, run.back().joint_position_rad);
  return {low, high};
}

struct Means {
  double torque_Nm = 0.0;
  double temperature_C = 0.0;
};
Means means_within(Run run, const Stretch& stretch) {
  Means means;
  double n = 0.0;
  for (const MotionSample& s : run) {
    if (s.joint_position_rad < stretch.low_rad || s.joint_position_rad > stretch.high_rad) continue;
    means.torque_Nm += s.torque_applied_Nm;
    means.temperature_C += s.temperature_C;
    n += 1.0;
  }
  return {means.torque_Nm / n, means.temperature_C / n};
}

std::optional<SteadyPoint> pair_of(Run there, Run back, const SteadyCriteria& criteria) {
  const double speed = there.front().setpoint_velocity_rad_s;
  if (std::abs(speed + back.front().setpoint_velocity_rad_s) > kSameSpeed * std::abs(speed))
    return std::nullopt;
  const Stretch a = stretch_of(there), b = stretch_of(back);
  const Stretch common{std::max(a.low_rad, b.low_rad), std::min(a.high_rad, b.high_rad)};
  if (common.length_rad() < criteria.least_overlap * std::max(a.length_rad(), b.length_rad()))
    return std::nullopt;
  const Means first = means_within(there, common), second = means_within(back, common);
  const double forward_Nm = speed > 0.0 ? first.torque_Nm : second.torque_Nm;
  const double backward_Nm = speed > 0.0 ? second.torque_Nm : first.torque_Nm;
  return SteadyPoint{0.5 * (first.temperature_C + second.temperature_C), std::abs(speed),
                     0.5 * (forward_Nm - backward_Nm), 0.5 * (forward_Nm + backward_Nm),
                     std::max(velocity_deviation_rad_s(there), velocity_deviation_rad_s(back))};
}

}  // namespace

SteadyPoints find_steady_points(const std::vector<MotionSample>& samples, double inertia_kgm2,
                                const SteadyCriteria& criteria) {
  SteadyPoints found;
  std::vector<Run> steady;
  for (const Run& whole : constant_runs(samples)) {
    const Run run = settled(whole, criteria);
    const auto unknown = [](const MotionSample& s) { return !std::isfinite(s.temperature_C); };
    if (static_cast<int>(run.size()) < criteria.least_samples) {
      ++found.too_short;
    } else if (std::any_of(run.begin(), run.end(), unknown)) {
      ++found.no_temperature;
    } else if (!is_steady(run, inertia_kgm2, criteria)) {
      ++found.not_steady;
    } else {
      steady.push_back(run);
    }
  }
  for (std::size_t i = 0; i < steady.size();) {
    const auto point = i + 1 < steady.size() ? pair_of(steady[i], steady[i + 1], criteria) : std::nullopt;
    if (point) found.points.push_back(*point);
    if (!point) ++found.without_return;
    i += point ? 2U : 1U;
  }
  return found;
}

}  // namespace strainwave
