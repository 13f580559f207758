// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/evidence.h"

#include <algorithm>

#include "strainwave/vocabulary.h"

namespace strainwave {

void Evidence::take(const state_v1& state) {
  // A repeated or older cycle comes from another daemon, or from a duplicated datagram.
  if (!samples.empty() && state.cycle <= samples.back().cycle) return;
  samples.push_back({.cycle = state.cycle,
                     .utime = state.utime,
                     .setpoint_velocity_rad_s = state.setpoint_velocity_rad_s,
                     .joint_position_rad = state.joint_position_rad,
                     .torque_commanded_Nm = state.torque_commanded_Nm,
                     .torque_applied_Nm = state.torque_applied_Nm,
                     .temperature_used_C = state.temperature_used_C,
                     .link_position_rad = state.link_position_rad,
                     .friction_factor = state.friction_factor,
                     .mode = state.mode,
                     .fault = state.fault,
                     .notices = state.notices,
                     .temperature_status = state.temperature_status,
                     .drive_error = state.drive_error});
}

void Evidence::take(const timing_v1& timing) {
  timings.push_back(timing);
  if (timing.period_s > 0.0) period_s = timing.period_s;
}

void Evidence::take(const limits_v1& published) {
  limits = published;
  if (published.period_s > 0.0) period_s = published.period_s;
  if (published.inertia_kgm2 > 0.0 && !told.inertia_kgm2) told.inertia_kgm2 = published.inertia_kgm2;
}

std::int64_t Evidence::stride_periods() const {
  if (samples.size() < 2) return 0;
  std::vector<std::int64_t> distances;
  for (std::size_t i = 1; i < samples.size(); ++i)
    distances.push_back(samples[i].cycle - samples[i - 1].cycle);
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  return *middle;
}

bool Evidence::chattered() const {
  return !samples.empty() && static_cast<Fault>(samples.back().fault) == Fault::kChatter;
}

double Evidence::mean_temperature_C() const {
  double sum = 0.0;
  double count = 0.0;
  for (const DoctorSample& sample : samples) {
    if (!std::isfinite(sample.temperature_used_C) || sample.temperature_status != 0) continue;
    sum += sample.temperature_used_C;
    ++count;
  }
  return sum / count;
}

std::optional<FrictionParameters> Evidence::friction_at(double temperature_C) const {
  if (!told.friction || !std::isfinite(temperature_C)) return std::nullopt;
  return told.friction->blend(told.friction->weights(temperature_C));
}

}  // namespace strainwave
