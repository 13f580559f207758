// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/stretches.h"

#include <algorithm>
#include <cmath>

#include "strainwave/vocabulary.h"

namespace strainwave {

namespace {

constexpr std::int64_t kMostBridged = 3;
constexpr std::size_t kShortest = 40;
// A lost torque must exceed a drive's ripple and the noise of its current.
constexpr double kLostShare = 0.05, kLost_Nm = 0.2;

bool controlled(const DoctorSample& sample) {
  const auto mode = static_cast<Mode>(sample.mode);
  return mode == Mode::kHolding || mode == Mode::kTracking || mode == Mode::kStopping;
}

void append(Stretch& stretch, const DoctorSample& sample) {
  stretch.position_rad.push_back(sample.joint_position_rad);
  stretch.torque_Nm.push_back(sample.torque_commanded_Nm);
  stretch.applied_Nm.push_back(sample.torque_applied_Nm);
  stretch.link_rad.push_back(sample.link_position_rad);
  stretch.at_rest.push_back(static_cast<Mode>(sample.mode) == Mode::kHolding &&
                            sample.setpoint_velocity_rad_s == 0.0);
}

void bridge(Stretch& stretch, const DoctorSample& from, const DoctorSample& to, std::int64_t stride) {
  const std::int64_t missing = (to.cycle - from.cycle) / stride - 1;
  for (std::int64_t i = 1; i <= missing; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(missing + 1);
    DoctorSample sample = from;
    sample.joint_position_rad += share * (to.joint_position_rad - from.joint_position_rad);
    append(stretch, sample);
  }
}

// Compares with the smallest recent command, since an oscillating torque with an unknown delay is not lost.
double lost_Nm(const Stretch& stretch, std::size_t i) {
  constexpr std::size_t kLately = 10;
  if (i < kLately) return 0.0;
  const double way = std::copysign(1.0, stretch.torque_Nm[i]);
  double least_Nm = way * stretch.torque_Nm[i];
  for (std::size_t k = i - kLately; k < i; ++k) least_Nm = std::min(least_Nm, way * stretch.torque_Nm[k]);
  const double missing_Nm = least_Nm - way * stretch.applied_Nm[i];
  return least_Nm > 0.0 && missing_Nm > kLostShare * least_Nm + kLost_Nm ? missing_Nm : 0.0;
}

void finish(Stretch& stretch, std::vector<Stretch>& stretches) {
  const std::size_t count = stretch.position_rad.size();
  if (count >= kShortest) {
    const auto reach = static_cast<std::size_t>(std::max(1.0, std::round(0.004 / stretch.step_s)));
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t before = i < reach ? 0 : i - reach;
      const std::size_t after = std::min(count - 1, i + reach);
      stretch.velocity_rad_s.push_back((stretch.position_rad[after] - stretch.position_rad[before]) /
                                       (static_cast<double>(after - before) * stretch.step_s));
    }
    for (std::size_t i = 0; i < count; ++i) stretch.lost_Nm.push_back(lost_Nm(stretch, i));
    stretches.push_back(std::move(stretch));
  }
  stretch = {};
}

}  // namespace

std::vector<Stretch> controlled_stretches(const Evidence& evidence) {
  std::vector<Stretch> stretches;
  const std::int64_t stride = evidence.stride_periods();
  if (stride <= 0) return stretches;
  Stretch stretch;
  const DoctorSample* before = nullptr;
  for (const DoctorSample& sample : evidence.samples) {
    const std::int64_t distance = before != nullptr ? sample.cycle - before->cycle : 0;
    const bool goes_on = before != nullptr && distance <= (kMostBridged + 1) * stride;
    if (!controlled(sample) || !std::isfinite(sample.joint_position_rad)) {
      finish(stretch, stretches);
      before = nullptr;
      continue;
    }
    if (before != nullptr && !goes_on) finish(stretch, stretches);
    if (goes_on && distance > stride) bridge(stretch, *before, sample, stride);
    stretch.step_s = static_cast<double>(stride) * evidence.period_s;
    append(stretch, sample);
    before = &sample;
  }
  finish(stretch, stretches);
  return stretches;
}

std::vector<double> link_acceleration(const std::vector<double>& drive_rad,
                                      const std::vector<double>& load_Nm, double step_s,
                                      const ConfiguredLink& told, double scale) {
  std::vector<double> acceleration;
  acceleration.reserve(drive_rad.size());
  double link_rad = drive_rad.front() - told.spring.angle_rad(load_Nm.front() / scale);
  double link_rad_s = 0.0;
  double lost_rad = 0.0;
  const double half_lost_rad = 0.5 * told.lost_motion_rad;
  const auto substeps = static_cast<int>(std::ceil(step_s / 2.5e-4));
  const double dt = step_s / substeps;
  for (std::size_t k = 0; k < drive_rad.size(); ++k) {
    const double next_rad = drive_rad[std::min(k + 1, drive_rad.size() - 1)];
    const double drive_rad_s = (next_rad - drive_rad[k]) / step_s;
    const double before_rad_s = link_rad_s;
    for (int i = 0; i < substeps; ++i) {
      const double wind_up_rad = drive_rad[k] + drive_rad_s * dt * (i + 0.5) - link_rad;
      const double bent_rad = dt * (drive_rad_s - link_rad_s);
      if (half_lost_rad > 0.0)
        lost_rad = std::clamp(lost_rad + bent_rad - std::abs(bent_rad) * lost_rad / half_lost_rad,
                              -half_lost_rad, half_lost_rad);
      const double torque_Nm =
          scale * (told.spring.torque_Nm(wind_up_rad) + told.spring.stiffness_1_Nm_rad * lost_rad) +
          std::sqrt(scale) * told.damping_Nms_rad * (drive_rad_s - link_rad_s) - load_Nm[k];
      link_rad_s += dt * torque_Nm / told.link_inertia_kgm2;
      link_rad += dt * link_rad_s;
    }
    acceleration.push_back((link_rad_s - before_rad_s) / step_s);
  }
  return acceleration;
}

}  // namespace strainwave
