// SPDX-License-Identifier: BSD-3-Clause
// Features from the daemon's own reports: temperature, faults, readings, timing, clocks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "doctor/features.h"
#include "doctor/stretches.h"
#include "lcmtypes/reading_doubt.h"
#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

constexpr double kShareTolerance = 0.002;  // of cycles that are late or missing on a healthy bus
constexpr double kClockTolerance = 1e-3;
constexpr double kJumpTolerance_s = 0.02;

template <typename Condition>
double share_of(const Evidence& evidence, const Condition& condition) {
  const auto count = std::count_if(evidence.samples.begin(), evidence.samples.end(), condition);
  return static_cast<double>(count) / static_cast<double>(evidence.samples.size());
}

auto with_notice(Notice notice) {
  return [notice](const DoctorSample& sample) {
    return (sample.notices & static_cast<std::int32_t>(notice)) != 0;
  };
}

void add_temperature(const Evidence& evidence, Features& features) {
  const double silent = share_of(evidence, [](const DoctorSample& sample) {
    const auto status = static_cast<TemperatureStatus>(sample.temperature_status);
    return status == TemperatureStatus::kNeverSeen || status == TemperatureStatus::kTooOld;
  });
  const double doubtful = share_of(evidence, [](const DoctorSample& sample) {
    const auto status = static_cast<TemperatureStatus>(sample.temperature_status);
    return status != TemperatureStatus::kValid && status != TemperatureStatus::kNeverSeen &&
           status != TemperatureStatus::kTooOld;
  });
  // A temperature outside the table's range is rare, but does not prove a wrong sensor.
  const double clamped = share_of(evidence, with_notice(Notice::kTemperatureClamped));
  double last_C = evidence.mean_temperature_C();
  for (const temperature_v1& temperature : evidence.temperatures) last_C = temperature.temperature_measured_C;
  features[Feature::kTemperatureSilent] =
      Observation{silent, 0.05, fmt::format("in {:.0f} % of the time no temperature came", 100.0 * silent)};
  features[Feature::kTemperatureDoubt] =
      Observation{doubtful + 0.25 * clamped, 0.05,
                  fmt::format("in {:.0f} % of the time the temperature was implausible, in {:.0f} % it was "
                              "outside the table; the last measured value was {:.1f} degC",
                              100.0 * doubtful, 100.0 * clamped, last_C)};
}

void add_faults(const Evidence& evidence, Features& features) {
  bool counts = false, power = false, bus = false;
  for (const DoctorSample& sample : evidence.samples) {
    const auto fault = static_cast<Fault>(sample.fault);
    counts = counts || (fault == Fault::kImplausibleReading &&
                        (sample.drive_error >> 24) == static_cast<int>(ReadingDoubt::kCountsMissing));
    power = power || fault == Fault::kPowerLost;
    bus = bus || fault == Fault::kBusError || fault == Fault::kConnectionLost || fault == Fault::kReadFailed;
  }
  const auto add = [&](Feature feature, bool seen, const char* text) {
    features[feature] = Observation{seen ? 1.0 : 0.0, 0.1, text};
  };
  add(Feature::kCountsFault, counts, "the drive found missing or wrong counts (fault 5, cause 6)");
  add(Feature::kPowerFault, power, "the supply failed (fault 4)");
  add(Feature::kBusFault, bus, "the bus failed (fault 1, 6 or 9)");
}

void add_bus(const Evidence& evidence, Features& features) {
  const double missed = share_of(evidence, with_notice(Notice::kReadingMissed));
  const double late = share_of(evidence, with_notice(Notice::kPositionLate));
  features[Feature::kReadingsMissed] = Observation{
      missed, kShareTolerance, fmt::format("in {:.2f} % of the cycles no position came", 100.0 * missed)};
  features[Feature::kPositionsLate] = Observation{
      late, kShareTolerance, fmt::format("in {:.2f} % of the cycles the position was late", 100.0 * late)};
}

// A few late cycles are no fault: many PCs without real time run a simulated joint well.
void add_timing(const Evidence& evidence, Features& features) {
  const bool late =
      std::any_of(evidence.samples.begin(), evidence.samples.end(), [](const DoctorSample& sample) {
        const auto fault = static_cast<Fault>(sample.fault);
        return fault == Fault::kLoopStalled || fault == Fault::kPeriodsMissed;
      });
  std::string text = "the loop was late (fault 21 or 22)";
  if (!evidence.timings.empty()) {
    const timing_v1& last = evidence.timings.back();
    text += fmt::format("; the longest wake-up took {:.2f} ms{}",
                        1e-6 * static_cast<double>(last.wakeup_latency_max_ns),
                        last.real_time != 0 ? "" : ", and the system refused real time to the daemon");
  }
  features[Feature::kLoopFault] = Observation{late ? 1.0 : 0.0, 0.1, text};
}

/// Least lead of the sender's clock over the loop's in each block of time. A late message looks like a lead; only a jump of the clock stays.
std::vector<double> least_leads_s(const Evidence& evidence, double block_s) {
  std::vector<double> least_s;
  double ends_s = 0.0;
  for (const DoctorSample& sample : evidence.samples) {
    if (sample.utime == 0) continue;
    const double at_s =
        static_cast<double>(sample.cycle - evidence.samples.front().cycle) * evidence.period_s;
    const double lead_s = 1e-6 * static_cast<double>(sample.utime - evidence.samples.front().utime) - at_s;
    if (least_s.empty() || at_s >= ends_s) {
      least_s.push_back(lead_s);
      ends_s = at_s + block_s;
    }
    least_s.back() = std::min(least_s.back(), lead_s);
  }
  return least_s;
}

void add_clock(const Evidence& evidence, Features& features) {
  constexpr double kBlock_s = 0.5;
  constexpr std::size_t kLeastBlocks = 4;
  const std::vector<double> lead_s = least_leads_s(evidence, kBlock_s);
  if (lead_s.size() < kLeastBlocks) {
    features.not_judged.emplace_back("clocks: the recording has no sender's times, or lasts less than 2 s");
    return;
  }
  double jumps_s = 0.0;
  double drift_s = 0.0;
  double drifted_s = 0.0;
  for (std::size_t i = 1; i < lead_s.size(); ++i) {
    const double step_s = lead_s[i] - lead_s[i - 1];
    if (std::abs(step_s) < kJumpTolerance_s) {
      drift_s += step_s;
      drifted_s += kBlock_s;
    } else {
      jumps_s = std::max(jumps_s, std::abs(step_s));
    }
  }
  const double rate = drifted_s > 0.0 ? drift_s / drifted_s : 0.0;
  features[Feature::kClockRate] =
      Observation{rate, kClockTolerance,
                  fmt::format("the clock of the daemon's messages goes {:+.2f} % against the loop's periods",
                              100.0 * rate)};
  features[Feature::kClockJumps] =
      Observation{jumps_s, kJumpTolerance_s,
                  fmt::format("the clock of the daemon's messages jumped by up to {:.3f} s", jumps_s)};
}

void add_supply(const Evidence& evidence, Features& features) {
  // Torque varies from period to period. If most samples are missing, an applied torque cannot be compared with its own command.
  if (evidence.stride_periods() > 2) {
    features.not_judged.emplace_back("sagging supply: set daemon.state_rate_Hz to the loop's rate");
    return;
  }
  double lost = 0.0, moving = 0.0, worst_Nm = 0.0, at_rad_s = 0.0;
  for (const Stretch& stretch : controlled_stretches(evidence))
    for (std::size_t i = 0; i < stretch.position_rad.size(); ++i) {
      if (std::abs(stretch.velocity_rad_s[i]) < 0.1) continue;
      ++moving;
      lost += stretch.torque_lost(i) ? 1.0 : 0.0;
      if (stretch.lost_Nm[i] <= worst_Nm) continue;
      worst_Nm = stretch.lost_Nm[i];
      at_rad_s = std::abs(stretch.velocity_rad_s[i]);
    }
  if (moving < 50) return;
  features[Feature::kTorqueLost] =
      Observation{lost / moving, 0.002,
                  fmt::format("in {:.1f} % of the motion the drive gave less torque than commanded, {:.1f} "
                              "N.m less at {:.2f} rad/s",
                              100.0 * lost / moving, worst_Nm, at_rad_s)};
}

}  // namespace

void add_daemon_features(const Evidence& evidence, Features& features) {
  if (evidence.samples.empty()) return;
  add_temperature(evidence, features);
  add_faults(evidence, features);
  add_bus(evidence, features);
  add_timing(evidence, features);
  add_clock(evidence, features);
  add_supply(evidence, features);
}

Features features_of(const Evidence& evidence) {
  Features features;
  add_motion_features(evidence, features);
  add_encoder_features(evidence, features);
  add_daemon_features(evidence, features);
  return features;
}

}  // namespace strainwave
