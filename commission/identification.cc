// SPDX-License-Identifier: BSD-3-Clause
#include "commission/identification.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/units.h"
#include "commission/motion_spans.h"

namespace strainwave {

namespace {

// Least share of the net work in the sum of absolute work. A smaller one does not show the sign of the torque.
constexpr double kLeastWorkShare = 0.2;
constexpr double kLeastWay_counts = 20.0;
constexpr std::size_t kRestSamples = 20;
// Largest relative change of speed from one end to the other of a motor turn that counts as steady.
constexpr double kSteady = 0.25;
// Largest swing of the torque over friction. The gear adds up to 10 % of its torque to friction (docs/flexible-joint.md), here 2 %.
constexpr double kEvenTorque = 0.2;
// Largest relative difference of speeds there and back that count as the same.
constexpr double kSameSpeed = 0.1;
// Samples of the fastest motor turn: 6000 RPM at a period of 1 ms.
constexpr std::size_t kLeastTurnSamples = 10;
// Least half width as a share of friction, for its variation with position and the torque's ripple (commission_study).
constexpr double kFrictionShare = 0.015;

/// The mean, and as half width 1.96 of its standard deviations, but at least `least`.
IntervalEstimate mean_of(const std::vector<double>& values, double least) {
  const auto n = static_cast<double>(values.size());
  double mean = 0.0;
  for (const double value : values) mean += value / n;
  double squares = 0.0;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double deviation = n > 1.0 ? std::sqrt(squares / (n - 1.0) / n) : 0.0;
  return {mean, std::max(least, 1.96 * deviation)};
}

/// One motor turn in one direction.
struct Turn {
  long number = 0;  ///< of the motor turn, from position 0
  double direction = 1.0;
  double speed_rad_s = 0.0;
  double torque_Nm = 0.0;  ///< mean, without the accelerating torque
  double swing_Nm = 0.0;   ///< of the torque around its mean, root mean square
  double temperature_C = 0.0;
};

/// The turn of samples first..end-1; nothing if its speed is not steady.
std::optional<Turn> steady_turn(const JointTrace& trace, const FrictionSearch& search, std::size_t first,
                                std::size_t end) {
  const auto n = static_cast<double>(end - first);
  const auto ago = static_cast<std::size_t>(std::lround(search.delay_s / trace.period_s));
  Turn turn;
  double squares = 0.0;
  for (std::size_t k = first; k < end; ++k) {
    const double torque = trace.samples[k > ago ? k - ago : 0].torque_ordered_Nm;
    turn.torque_Nm += torque / n;
    squares += torque * torque / n;
  }
  turn.swing_Nm = std::sqrt(std::max(0.0, squares - turn.torque_Nm * turn.torque_Nm));
  const double change_rad_s = speed_around(trace, end) - speed_around(trace, first);
  turn.torque_Nm -= search.inertia_kgm2 * change_rad_s / (n * trace.period_s);
  turn.speed_rad_s =
      std::abs(trace.samples[end].motor_position_rad - trace.samples[first].motor_position_rad) /
      (n * trace.period_s);
  turn.temperature_C = trace.samples[first].temperature_C;
  const bool steady = std::abs(change_rad_s) < kSteady * turn.speed_rad_s;
  return steady ? std::optional(turn) : std::nullopt;
}

/// Every whole turn at steady speed.
std::vector<Turn> steady_turns(const JointTrace& trace, const FrictionSearch& search) {
  const double turn_rad = kTurn_rad / search.gear_ratio;
  std::vector<Turn> turns;
  for (const MotionSpan& span : sliding_spans(trace, search.gear_ratio, kLeastTurnSamples)) {
    const auto number_at = [&](std::size_t k) {
      return static_cast<long>(std::floor(trace.samples[k].motor_position_rad / turn_rad));
    };
    std::optional<std::size_t> first;  // first sample of a turn that began in this span
    for (std::size_t k = span.first + 1; k < span.first + span.count; ++k) {
      if (number_at(k) == number_at(k - 1)) continue;
      std::optional<Turn> turn = first ? steady_turn(trace, search, *first, k) : std::nullopt;
      if (turn) {
        turn->number = number_at(k - 1);
        turn->direction = span.direction;
        turns.push_back(*turn);
      }
      first = k;
    }
  }
  return turns;
}

/// One motor turn there and back.
struct FrictionSample {
  double speed_rad_s = 0.0;
  double temperature_C = 0.0;
  double friction_Nm = 0.0;
};

/// Nothing unless they are the same turn there and back, at one speed, under an even torque.
std::optional<FrictionSample> friction_of(const Turn& there, const Turn& back) {
  const bool one_turn = there.direction > 0.0 && back.direction < 0.0 && there.number == back.number;
  const bool one_speed = std::abs(there.speed_rad_s - back.speed_rad_s) <= kSameSpeed * there.speed_rad_s;
  const double friction_Nm = 0.5 * (there.torque_Nm - back.torque_Nm);
  const bool even = std::max(there.swing_Nm, back.swing_Nm) < kEvenTorque * friction_Nm;
  if (!one_turn || !one_speed || !even) return std::nullopt;
  return FrictionSample{0.5 * (there.speed_rad_s + back.speed_rad_s),
                        0.5 * (there.temperature_C + back.temperature_C), friction_Nm};
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
        // The ramp goes on rising until the joint is seen to slide.
        torques[way].push_back(std::abs(trace.samples[left_at].torque_ordered_Nm));
        uncertainty[way] = std::max(uncertainty[way], most - torques[way].back());
      }
      rest = 0;
    }
  }
  std::array<std::optional<IntervalEstimate>, 2> found;
  for (std::size_t way = 0; way < 2; ++way)
    if (!torques[way].empty()) found[way] = mean_of(torques[way], uncertainty[way]);
  return found;
}

FrictionSearch friction_search(double gear_ratio, const std::optional<MotionEstimates>& motion) {
  if (!motion) return {gear_ratio, 0.0, 0.0};
  return {gear_ratio, motion->total_inertia_kgm2.value, motion->delay_s.value};
}

std::vector<FrictionAtSpeed> find_friction(const JointTrace& trace, const FrictionSearch& search) {
  std::vector<FrictionSample> samples;
  const std::vector<Turn> turns = steady_turns(trace, search);
  for (const Turn& there : turns)
    for (const Turn& back : turns)
      if (const auto sample = friction_of(there, back)) samples.push_back(*sample);
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
    if (torques.size() > 1) points.push_back(point);  // a single one has no spread
  }
  return points;
}

JointEstimates identify(const JointTrace& trace, const ToldJoint& told) {
  JointEstimates found;
  found.direction = find_direction(trace);
  const auto breakaway = find_breakaway(trace, told.gear_ratio);
  found.breakaway_positive_Nm = breakaway[0];
  found.breakaway_negative_Nm = breakaway[1];
  found.motion = fit_motion(trace, told);
  found.friction = find_friction(trace, friction_search(told.gear_ratio, found.motion));
  return found;
}

}  // namespace strainwave
