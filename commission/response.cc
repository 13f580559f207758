// SPDX-License-Identifier: BSD-3-Clause
#include "commission/response.h"

#include <cmath>
#include <complex>

#include "base/units.h"
#include "commission/motion_spans.h"
#include "commission/sine_sum.h"

namespace strainwave {

namespace {

using Complex = std::complex<double>;

constexpr double kStretch_s = 0.8;

/// Sums at one frequency over all stretches.
struct Spectrum {
  Complex cross;
  double power = 0.0;
};

/// Speed in rad/s by central differences, which are sin(wT) / (wT) of the velocity.
double speed_at(const JointTrace& trace, std::size_t k) {
  return (trace.samples[k + 1].motor_position_rad - trace.samples[k - 1].motor_position_rad) /
         (2.0 * trace.period_s);
}

void add_stretch(const JointTrace& trace, std::size_t first, std::size_t count, double frequency_Hz,
                 Spectrum& spectrum) {
  double mean_torque = 0.0;
  double mean_speed = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    mean_torque += trace.samples[first + i].torque_ordered_Nm / static_cast<double>(count);
    mean_speed += speed_at(trace, first + i) / static_cast<double>(count);
  }
  Complex torque;
  Complex speed;
  const double turn = kTurn_rad * frequency_Hz * trace.period_s;
  for (std::size_t i = 0; i < count; ++i) {
    const auto n = static_cast<double>(i);
    const double window = 1.0 - std::cos(kTurn_rad * (n + 0.5) / static_cast<double>(count));
    const Complex turning = std::polar(window, -turn * n);
    torque += (trace.samples[first + i].torque_ordered_Nm - mean_torque) * turning;
    speed += (speed_at(trace, first + i) - mean_speed) * turning;
  }
  spectrum.cross += std::conj(torque) * speed * (turn / std::sin(turn));
  spectrum.power += std::norm(torque);
}

}  // namespace

std::vector<ResponsePoint> measure_response(const JointTrace& trace, double gear_ratio) {
  const auto length = static_cast<std::size_t>(kStretch_s / trace.period_s);
  const std::vector<MotionSpan> spans = sliding_spans(trace, gear_ratio, length + 2);
  std::vector<ResponsePoint> points;
  for (const double frequency_Hz : SineSum::frequencies_Hz()) {
    if (frequency_Hz > 0.25 / trace.period_s) break;
    Spectrum spectrum;
    for (const MotionSpan& span : spans)
      for (std::size_t first = span.first + 1; first + length + 1 < span.first + span.count;
           first += length / 2)
        add_stretch(trace, first, length, frequency_Hz, spectrum);
    if (spectrum.power == 0.0) continue;
    const Complex response = spectrum.cross / spectrum.power;
    points.push_back({frequency_Hz, std::abs(response), std::arg(response)});
  }
  return points;
}

}  // namespace strainwave
