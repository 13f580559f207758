// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/units.h"
#include "commission/excitation.h"
#include "commission/motion_spans.h"

namespace strainwave {

namespace {

// Share of the position range that each end keeps free for braking and the guard.
constexpr double kMargin = 0.1;
constexpr int kSpeeds = 4;
constexpr int kShakenStrokes = 20;
// A stroke lasts at most this time at its speed, unless this number of motor turns takes longer.
constexpr double kLongestStroke_s = 4.0;
constexpr double kLeastTurns = 2.3;
constexpr double kTopSpeedShare = 0.6;  // of the speed limit
// Least speed limit, in sliding speeds. The first strokes run at three, and five standard deviations of their swing need up to three more.
constexpr double kLeastSpeed = 6.0;

/// Distance of planned positions from the limits.
double margin_rad(const ExcitationLimits& limits) {
  return kMargin * (limits.position_max_rad - limits.position_min_rad);
}

/// Three standard deviations of the swing take up to 0.8 of this speed (excitation.cc). Five of them then stay below the speed limit.
double shaken_speed_rad_s(const ExcitationConfig& config, double way_rad) {
  const double sliding = sliding_speed_rad_s(config.gear_ratio);
  return std::clamp(way_rad / 1.5, std::min(3.0 * sliding, kTopSpeedShare * config.limits.speed_rad_s),
                    0.4 * config.limits.speed_rad_s);
}

}  // namespace

std::vector<Stroke> plan_strokes(const ExcitationConfig& config) {
  const ExcitationLimits& limits = config.limits;
  const double low = limits.position_min_rad + margin_rad(limits);
  const double high = limits.position_max_rad - margin_rad(limits);
  const double turn_rad = kTurn_rad / config.gear_ratio;
  if (config.start_rad < low || config.start_rad > high)
    throw InputError(
        "commission", "position_rad", std::to_string(config.start_rad),
        "must be within " + std::to_string(low) + " to " + std::to_string(high) +
            " rad, which leaves a tenth of the range to each of joint.limits: move the joint there");
  if (high - low < kLeastTurns * turn_rad)
    throw InputError(
        "joint.limits", "position_max_rad", std::to_string(limits.position_max_rad),
        "must be at least " + std::to_string(kLeastTurns * turn_rad / (1.0 - 2.0 * kMargin)) +
            " rad above position_min_rad: 2.3 turns of the motor, and a tenth of the range at each end");
  const double least_rad_s = kLeastSpeed * sliding_speed_rad_s(config.gear_ratio);
  if (limits.speed_rad_s < least_rad_s)
    throw InputError(
        "joint.limits", "speed_limit_rad_s", std::to_string(limits.speed_rad_s),
        "must be at least " + std::to_string(least_rad_s) + " rad/s: below this, the motor sticks and slips");
  const double slowest = 1.5 * sliding_speed_rad_s(config.gear_ratio);
  const double fastest = std::min(kTopSpeedShare * limits.speed_rad_s,
                                  std::sqrt(0.25 * limits.acceleration_rad_s2 * (high - low)));
  if (fastest < 1.2 * slowest)
    throw InputError("joint.limits", "acceleration_rad_s2", std::to_string(limits.acceleration_rad_s2),
                     "must be larger, or the position limits further apart: the motor sticks and slips "
                     "below " +
                         std::to_string(1.2 * slowest) + " rad/s");
  std::vector<Stroke> strokes;
  if (config.part == ExcitationPart::kRamps) return strokes;
  const double middle = 0.5 * (low + high);
  const auto way_at = [&](double speed_rad_s) {
    return std::min(high - low, std::max(kLeastTurns * turn_rad, speed_rad_s * kLongestStroke_s) +
                                    speed_rad_s * speed_rad_s / limits.acceleration_rad_s2);
  };
  // The first strokes are slow and gentle. They show the inertia, without which later strokes cannot reverse in time.
  for (const double side : {0.5, -0.5})
    strokes.push_back({middle + side * way_at(2.0 * slowest), 2.0 * slowest, true});
  const int speeds = config.part == ExcitationPart::kShakenStrokes ? 0 : kSpeeds;
  for (int i = 0; i < speeds; ++i) {
    const double speed = slowest * std::pow(fastest / slowest, static_cast<double>(i) / (kSpeeds - 1));
    const double way = way_at(speed);
    strokes.push_back({middle - 0.5 * way, speed, false});
    strokes.push_back({middle + 0.5 * way, speed, false});
    strokes.push_back({middle - 0.5 * way, speed, false});
  }
  const int shaken = config.part == ExcitationPart::kSteadyStrokes ? 0 : kShakenStrokes;
  const double shaken_rad_s = shaken_speed_rad_s(config, high - low);
  for (int i = 0; i < shaken; ++i)
    strokes.push_back({middle + (i % 2 == 0 ? 0.5 : -0.5) * way_at(shaken_rad_s), shaken_rad_s, true});
  return strokes;
}

}  // namespace strainwave
