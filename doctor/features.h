// SPDX-License-Identifier: BSD-3-Clause
// What of a recording differs from what is configured, each as a number that is about 0 for a healthy joint. Not real-time.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "doctor/evidence.h"

namespace strainwave {

enum class Feature : std::size_t {
  kReversed,   ///< 1: torque accelerates the joint against its sign
  kInertia,    ///< ln of measured over configured
  kCoulomb,    ///< likewise, of friction at slow speed
  kViscous,    ///< likewise, of friction's slope over speed
  kStiffness,  ///< likewise
  kDelay,      ///< measured less configured, periods
  kTorqueLag,  ///< what the drive says it applied comes later than the configured delay, periods; never negative
  kLoad,       ///< what pushes besides the configured gravity, N.m
  kLinkRatio,          ///< ln of the link's motion over the motor's, slow motion
  kLinkRatioFast,      ///< the same of fast motion, less that of slow motion
  kLinkJumps,          ///< turns of link against motor while the joint accelerates, rad
  kNoise,              ///< ln of the position's noise over a count
  kTorqueLost,         ///< share of motion in which the drive delivers less than is commanded
  kTemperatureSilent,  ///< share of time without a temperature
  kTemperatureDoubt,   ///< share of time with a temperature that cannot be
  kCountsFault,        ///< 1: the drive found missing counts
  kPowerFault,         ///< 1: the supply failed
  kBusFault,           ///< 1: the bus failed
  kReadingsMissed,     ///< share of cycles
  kPositionsLate,      ///< share of cycles
  kLoopFault,          ///< 1: the loop was so late that the daemon faulted the joint
  kClockRate,          ///< sender's clock against the loop's, share
  kClockJumps          ///< sudden steps of the sender's clock, s
};
inline constexpr std::size_t kFeatureCount = static_cast<std::size_t>(Feature::kClockJumps) + 1;

struct Observation {
  double value = 0.0;
  double tolerance = 1.0;  ///< standard deviation over healthy joints, and of the measurement
  std::string text;        ///< with numbers and units

  double normalised() const { return value / tolerance; }
};

struct Features {
  std::array<std::optional<Observation>, kFeatureCount>
      observations;                     ///< nothing: the recording does not show it
  std::vector<std::string> not_judged;  ///< what, and what it needs

  std::optional<Observation>& operator[](Feature feature) {
    return observations[static_cast<std::size_t>(feature)];
  }
  const std::optional<Observation>& operator[](Feature feature) const {
    return observations[static_cast<std::size_t>(feature)];
  }
};

Features features_of(const Evidence& evidence);

// Its parts.
void add_motion_features(const Evidence& evidence, Features& features);   ///< motion_features.cc
void add_encoder_features(const Evidence& evidence, Features& features);  ///< encoder_features.cc
void add_daemon_features(const Evidence& evidence, Features& features);   ///< daemon_features.cc

}  // namespace strainwave
