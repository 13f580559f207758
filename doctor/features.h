// SPDX-License-Identifier: BSD-3-Clause
// Differences between a recording and the configuration, each as a number that is about 0 for a healthy joint. Not real-time.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "doctor/evidence.h"

namespace strainwave {

enum class Feature : std::size_t {
  kReversed,           ///< 1: torque accelerates the joint against its sign
  kInertia,            ///< ln of measured over configured
  kCoulomb,            ///< likewise, for friction at slow speed
  kViscous,            ///< likewise, for the slope of friction over speed
  kStiffness,          ///< likewise, for stiffness
  kDelay,              ///< measured minus configured, periods
  kTorqueLag,          ///< delay of the reported torque minus the configured delay, periods; never negative
  kLoad,               ///< load in addition to the configured gravity, N.m
  kLinkRatio,          ///< ln of the link's travel over the motor's, in slow motion
  kLinkRatioFast,      ///< the same for fast motion, minus that for slow motion
  kLinkJumps,          ///< slip of the link against the motor while the joint accelerates, rad
  kNoise,              ///< ln of the position's noise over a count
  kTorqueLost,         ///< share of motion in which the drive delivers less than is commanded
  kTemperatureSilent,  ///< share of time without a temperature
  kTemperatureDoubt,   ///< share of time with an implausible temperature
  kCountsFault,        ///< 1: the drive found missing counts
  kPowerFault,         ///< 1: the supply failed
  kBusFault,           ///< 1: the bus failed
  kReadingsMissed,     ///< share of cycles
  kPositionsLate,      ///< share of cycles
  kLoopFault,          ///< 1: the loop was so late that the daemon faulted the joint
  kClockRate,          ///< relative rate of the sender's clock against the loop's
  kClockJumps          ///< sudden steps of the sender's clock, s
};
inline constexpr std::size_t kFeatureCount = static_cast<std::size_t>(Feature::kClockJumps) + 1;

struct Observation {
  double value = 0.0;
  double tolerance = 1.0;  ///< standard deviation over healthy joints, with that of the measurement
  std::string text;        ///< description with numbers and units

  double normalised() const { return value / tolerance; }
};

struct Features {
  std::array<std::optional<Observation>, kFeatureCount>
      observations;                     ///< nothing: the recording does not show it
  std::vector<std::string> not_judged;  ///< what is not judged, and what it needs

  std::optional<Observation>& operator[](Feature feature) {
    return observations[static_cast<std::size_t>(feature)];
  }
  const std::optional<Observation>& operator[](Feature feature) const {
    return observations[static_cast<std::size_t>(feature)];
  }
};

Features features_of(const Evidence& evidence);

// Parts of features_of().
void add_motion_features(const Evidence& evidence, Features& features);   ///< motion_features.cc
void add_encoder_features(const Evidence& evidence, Features& features);  ///< encoder_features.cc
void add_daemon_features(const Evidence& evidence, Features& features);   ///< daemon_features.cc

}  // namespace strainwave
