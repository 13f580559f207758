// SPDX-License-Identifier: BSD-3-Clause
#include "commission/motion_spans.h"

#include <algorithm>
#include <cmath>

#include "base/units.h"

namespace strainwave {

namespace {
constexpr std::size_t kHalfSpan = 4;

double speed_within(const JointTrace& trace, std::size_t sample, std::size_t half_span) {
  const std::size_t from = sample > half_span ? sample - half_span : 0;
  const std::size_t to = std::min(sample + half_span, trace.samples.size() - 1);
  if (to <= from) return 0.0;
  return (trace.samples[to].motor_position_rad - trace.samples[from].motor_position_rad) /
         (trace.period_s * static_cast<double>(to - from));
}

// As short as the encoder allows, since a joint that swings may stick for two periods. One count is at most a quarter of `slowest_rad_s`.
std::size_t shortest_half_span(const JointTrace& trace, double slowest_rad_s) {
  const double periods = 2.0 * trace.encoder_resolution_rad / (trace.period_s * slowest_rad_s);
  return std::clamp<std::size_t>(static_cast<std::size_t>(std::ceil(periods)), 1, kHalfSpan);
}

}  // namespace

double speed_around(const JointTrace& trace, std::size_t sample) {
  return speed_within(trace, sample, kHalfSpan);
}

double sliding_speed_rad_s(double gear_ratio) {
  return joint_velocity_rad_s_from_motor_rpm(2.0 * 20.0, gear_ratio);
}

std::vector<MotionSpan> sliding_spans(const JointTrace& trace, double gear_ratio, std::size_t least) {
  const double slowest = sliding_speed_rad_s(gear_ratio);
  const std::size_t half_span = shortest_half_span(trace, slowest);
  std::vector<MotionSpan> spans;
  MotionSpan open{0, 0, 0.0};
  const auto close = [&](std::size_t end) {
    // The speed is a mean, so the joint may still stick at the ends of a span.
    if (open.direction != 0.0 && end > open.first + least + 2 * half_span)
      spans.push_back({open.first + half_span, end - open.first - 2 * half_span, open.direction});
    open.direction = 0.0;
  };
  for (std::size_t i = 0; i < trace.samples.size(); ++i) {
    const double speed = speed_within(trace, i, half_span);
    const double direction = std::abs(speed) > slowest ? std::copysign(1.0, speed) : 0.0;
    if (direction == open.direction) continue;
    close(i);
    if (direction != 0.0) open = {i, 0, direction};
  }
  close(trace.samples.size());
  return spans;
}

}  // namespace strainwave
