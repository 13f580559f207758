// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "commission/excitation.h"
#include "commission/motion_spans.h"
#include "control/units.h"

namespace strainwave {

namespace {

// Of the way between the limits, at either end: what braking and the guard need.
constexpr double kMargin = 0.1;
constexpr int kSpeeds = 4;
constexpr int kShakenStrokes = 20;
// Steady strokes last at most so long, and at least these motor turns.
constexpr double kLongestStroke_s = 4.0;
constexpr double kLeastTurns = 2.3;
constexpr double kTopSpeedShare = 0.6;  // of the speed limit

/// Planned positions have this from the limits.
double margin_rad(const ExcitationLimits& limits) {
  return kMargin * (limits.position_max_rad - limits.position_min_rad);
}

/// The swing on top takes up to 0.8 of it in three standard deviations (excitation.cc): five of them stay below the speed limit.
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
    throw InputError("commission", "position_rad", std::to_string(config.start_rad),
                     "must be within " + std::to_string(low) + " to " + std::to_string(high) +
                         " rad, a tenth inside of joint.limits: move the joint there");
  if (high - low < kLeastTurns * turn_rad)
    throw InputError("joint.limits", "position_max_rad", std::to_string(limits.position_max_rad),
                     "must be at least " + std::to_string(kLeastTurns * turn_rad / (1.0 - 2.0 * kMargin)) +
                         " rad above position_min_rad: the motor must turn twice");
  const double slowest = 1.5 * sliding_speed_rad_s(config.gear_ratio);
  const double fastest = std::min(kTopSpeedShare * limits.speed_rad_s,
                                  std::sqrt(0.25 * limits.acceleration_rad_s2 * (high - low)));
  if (fastest < 1.2 * slowest)
    throw InputError("joint.limits", "speed_limit_rad_s", std::to_string(limits.speed_rad_s),
                     "must be at least " + std::to_string(1.2 * slowest / kTopSpeedShare) +
                         " rad/s: below, the motor sticks and slips");
  std::vector<Stroke> strokes;
  if (config.part == ExcitationPart::kRamps) return strokes;
  const double middle = 0.5 * (low + high);
  // Slowly and gently first: the inertia that this shows is needed to turn round in time.
  for (const double to : {high, low}) strokes.push_back({to, 2.0 * slowest, true});
  const int speeds = config.part == ExcitationPart::kShakenStrokes ? 0 : kSpeeds;
  for (int i = 0; i < speeds; ++i) {
    const double speed = slowest * std::pow(fastest / slowest, static_cast<double>(i) / (kSpeeds - 1));
    const double ramps = speed * speed / limits.acceleration_rad_s2;
    const double way =
        std::min(high - low, std::max(kLeastTurns * turn_rad, speed * kLongestStroke_s) + ramps);
    strokes.push_back({middle - 0.5 * way, speed, false});
    strokes.push_back({middle + 0.5 * way, speed, false});
    strokes.push_back({middle - 0.5 * way, speed, false});
  }
  const int shaken = config.part == ExcitationPart::kSteadyStrokes ? 0 : kShakenStrokes;
  for (int i = 0; i < shaken; ++i)
    strokes.push_back({i % 2 == 0 ? high : low, shaken_speed_rad_s(config, high - low), true});
  return strokes;
}

}  // namespace strainwave
