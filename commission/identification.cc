// SPDX-License-Identifier: BSD-3-Clause
#include "commission/identification.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "commission/motion_spans.h"
#include "control/units.h"

namespace strainwave {

namespace {

// Below this share of the torque's work there and back, what is left does not say which way friction acts.
constexpr double kLeastWorkShare = 0.2;
constexpr double kLeastWay_counts = 20.0;
constexpr std::size_t kRestSamples = 20;
// A stretch of steady speed keeps within this share of its first speed, as a mean over so many samples, and its speed around that mean
// has less than this share, root mean square.
constexpr double kSteady = 0.1;
constexpr double kRipple = 0.15;
constexpr std::size_t kSteadySamples = 50;
// Speeds there and back that count as the same.
constexpr double kSameSpeed = 0.1;
// Of friction, what its place on the way and the torque's ripple leave: commission_study.
constexpr double kFrictionShare = 0.015;

/// Mean and 1.96 standard deviations of it, with `least` at least.
IntervalEstimate mean_of(const std::vector<double>& values, double least) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double value : values) mean += value / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double deviation = n > 1.0 ? std::sqrt(squares / (n - 1.0) / n) : 0.0;
  return {mean, std::max(least, 1.96 * deviation)};
}

/// Steady motion one way.
struct SteadyRun {
  std::size_t first = 0;
  std::size_t end = 0;
  double direction = 1.0;
  double speed_rad_s = 0.0;
};

double mean_speed(const JointTrace& trace, std::size_t from, std::size_t to) {
  return (trace.samples[to].motor_position_rad - trace.samples[from].motor_position_rad) /
         (trace.period_s * static_cast<double>(to - from));
}

/// Of the speed over 8 periods around `speed`, root mean square, as a share of it.
double ripple(const JointTrace& trace, std::size_t first, std::size_t last, double speed) {
  double squares = 0.0;
  for (std::size_t k = first; k < last; ++k) squares += std::pow(speed_around(trace, k) / speed - 1.0, 2);
  return std::sqrt(squares / static_cast<double>(last - first));
}

std::vector<SteadyRun> steady_runs(const JointTrace& trace, double gear_ratio) {
  const double turn_rad = kTurn_rad / gear_ratio;
  std::vector<SteadyRun> runs;
  for (const MotionSpan& span : sliding_spans(trace, gear_ratio, 2 * kSteadySamples)) {
    const std::size_t end = span.first + span.count;
    for (std::size_t first = span.first; first + kSteadySamples < end;) {
      const double start_speed = mean_speed(trace, first, first + kSteadySamples);
      std::size_t last = first + 1;
      while (last + kSteadySamples < end && std::abs(mean_speed(trace, last, last + kSteadySamples) -
                                                     start_speed) < kSteady * std::abs(start_speed))
        ++last;
      const double speed = mean_speed(trace, first, last);
      const double way = std::abs(speed) * trace.period_s * static_cast<double>(last - first);
      if (way >= turn_rad && ripple(trace, first, last, speed) < kRipple)
        runs.push_back({first, last, span.direction, std::abs(speed)});
      first = way >= turn_rad ? last : first + kSteadySamples / 2;
    }
  }
  return runs;
}

/// Over one motor turn.
struct TurnMean {
  double torque_Nm = 0.0;  ///< without what changed the speed
  double speed_rad_s = 0.0;
};

/// Of `run` over positions from..to, for each whole turn of them.
std::vector<TurnMean> means_by_turn(const JointTrace& trace, const SteadyRun& run, double from, double to,
                                    int turns, double inertia_kgm2) {
  std::vector<TurnMean> means(static_cast<std::size_t>(turns));
  std::vector<double> counts(means.size(), 0.0);
  for (std::size_t k = run.first; k < run.end; ++k) {
    const double share = (trace.samples[k].motor_position_rad - from) / (to - from);
    if (share < 0.0 || share >= 1.0) continue;
    const auto turn = static_cast<std::size_t>(share * turns);
    const double speed = speed_around(trace, k);
    const double acceleration = (speed_around(trace, k + 1) - speed) / trace.period_s;
    means[turn].torque_Nm += trace.samples[k].torque_ordered_Nm - inertia_kgm2 * acceleration;
    means[turn].speed_rad_s += speed;
    counts[turn] += 1.0;
  }
  for (std::size_t i = 0; i < means.size(); ++i) {
    means[i].torque_Nm /= std::max(1.0, counts[i]);
    means[i].speed_rad_s /= std::max(1.0, counts[i]);
  }
  return means;
}

/// One motor turn there and back.
struct FrictionSample {
  double speed_rad_s = 0.0;
  double temperature_C = 0.0;
  double friction_Nm = 0.0;
};

/// What `there` and `back` have in common: whole turns of the same positions.
void pair_up(const JointTrace& trace, const SteadyRun& there, const SteadyRun& back,
             const FrictionSearch& search, std::vector<FrictionSample>& samples) {
  const auto position = [&](std::size_t k) { return trace.samples[k].motor_position_rad; };
  const double low = std::max(position(there.first), position(back.end - 1));
  const double high = std::min(position(there.end - 1), position(back.first));
  const double turn_rad = kTurn_rad / search.gear_ratio;
  const int turns = static_cast<int>((high - low) / turn_rad);
  if (turns < 1) return;
  const double end = low + turns * turn_rad;
  const std::vector<TurnMean> up = means_by_turn(trace, there, low, end, turns, search.inertia_kgm2);
  const std::vector<TurnMean> down = means_by_turn(trace, back, low, end, turns, search.inertia_kgm2);
  for (std::size_t i = 0; i < up.size(); ++i)
    samples.push_back({0.5 * (up[i].speed_rad_s - down[i].speed_rad_s),
                       trace.samples[there.end - 1].temperature_C,
                       0.5 * (up[i].torque_Nm - down[i].torque_Nm)});
}

}  // namespace

std::optional<int> find_direction(const JointTrace& trace) {
  double work = 0.0, sum = 0.0, way = 0.0;
  for (std::size_t k = 1; k < trace.samples.size(); ++k) {
    const double moved = trace.samples[k].motor_position_rad - trace.samples[k - 1].motor_position_rad;
    work += trace.samples[k - 1].torque_ordered_Nm * moved;
    sum += std::abs(trace.samples[k - 1].torque_ordered_Nm * moved);
    way += std::abs(moved);
  }
  if (way < kLeastWay_counts * trace.encoder_resolution_rad || std::abs(work) <= kLeastWorkShare * sum)
    return std::nullopt;
  return work > 0.0 ? 1 : -1;
}

std::array<std::optional<IntervalEstimate>, 2> find_breakaway(const JointTrace& trace, double gear_ratio) {
  const double sliding = sliding_speed_rad_s(gear_ratio);
  std::array<std::vector<double>, 2> torques;
  std::array<double, 2> uncertainty{};
  std::size_t rest = 0;
  std::size_t left_at = 0;
  for (std::size_t k = 0; k < trace.samples.size(); ++k) {
    const double speed = speed_around(trace, k);
    if (std::abs(speed) < 0.1 * sliding) {
      ++rest;
      left_at = k;
    } else if (std::abs(speed) >= sliding) {
      if (rest >= kRestSamples) {
        const std::size_t way = speed > 0.0 ? 0 : 1;
        double most = 0.0;
        for (std::size_t i = left_at; i <= k; ++i)
          most = std::max(most, std::abs(trace.samples[i].torque_ordered_Nm));
        torques[way].push_back(most);
        uncertainty[way] =
            std::max(uncertainty[way], most - std::abs(trace.samples[left_at].torque_ordered_Nm));
      }
      rest = 0;
    }
  }
  std::array<std::optional<IntervalEstimate>, 2> found;
  for (std::size_t way = 0; way < 2; ++way)
    if (!torques[way].empty()) found[way] = mean_of(torques[way], uncertainty[way]);
  return found;
}

std::vector<FrictionAtSpeed> find_friction(const JointTrace& trace, const FrictionSearch& search) {
  std::vector<FrictionSample> samples;
  const std::vector<SteadyRun> runs = steady_runs(trace, search.gear_ratio);
  for (const SteadyRun& there : runs)
    for (const SteadyRun& back : runs)
      if (there.direction > 0.0 && back.direction < 0.0 &&
          std::abs(there.speed_rad_s - back.speed_rad_s) <= kSameSpeed * there.speed_rad_s)
        pair_up(trace, there, back, search, samples);
  std::sort(samples.begin(), samples.end(),
            [](const FrictionSample& a, const FrictionSample& b) { return a.speed_rad_s < b.speed_rad_s; });
  std::vector<FrictionAtSpeed> points;
  for (std::size_t first = 0; first < samples.size();) {
    std::vector<double> torques;
    FrictionAtSpeed point;
    const double fastest = (1.0 + kSameSpeed) * samples[first].speed_rad_s;
    for (; first < samples.size() && samples[first].speed_rad_s <= fastest; ++first) {
      torques.push_back(samples[first].friction_Nm);
      point.speed_rad_s += samples[first].speed_rad_s;
      point.temperature_C += samples[first].temperature_C;
    }
    const auto n = static_cast<double>(torques.size());
    point.speed_rad_s /= n;
    point.temperature_C /= n;
    point.torque_Nm = mean_of(torques, 0.0);
    point.torque_Nm.half_width_95 =
        std::max(point.torque_Nm.half_width_95, kFrictionShare * point.torque_Nm.value);
    points.push_back(point);
  }
  return points;
}

JointEstimates identify(const JointTrace& trace, const ToldJoint& told) {
  JointEstimates found;
  found.direction = find_direction(trace);
  std::tie(found.breakaway_positive_Nm, found.breakaway_negative_Nm) = [&] {
    const auto both = find_breakaway(trace, told.gear_ratio);
    return std::pair(both[0], both[1]);
  }();
  found.motion = fit_motion(trace, told);
  found.friction =
      find_friction(trace, {told.gear_ratio, found.motion ? found.motion->total_inertia_kgm2.value : 0.0});
  return found;
}

}  // namespace strainwave
