// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/closed_loop.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/units.h"

namespace strainwave {

namespace {

constexpr double kLargestPosition_rad = 1e6;
constexpr double kTemperatureJump_C = 0.5;  // between two samples; slower changes start no new stretch
constexpr double kSteadyFraction = 0.2;
constexpr double kLongestRun_s = 1e6;

double error_rad(const TracePoint& point) {
  return point.setpoint_position_rad - point.joint_position_rad;
}

std::size_t sample_count(const ClosedLoopConfig& config) {
  if (!(config.duration_s > 0.0 && config.duration_s <= kLongestRun_s))
    throw InputError("closed loop", "duration_s", number_text(config.duration_s), "must be in (0, 1e6]");
  return static_cast<std::size_t>(std::ceil(config.duration_s / config.plant.period_s - 1e-9));
}

using Iterator = std::vector<TracePoint>::const_iterator;

bool same_setpoint(const TracePoint& a, const TracePoint& b) {
  return a.setpoint_position_rad == b.setpoint_position_rad;
}

/// End of the stretch that begins at `begin`.
Iterator stretch_end(Iterator begin, Iterator end) {
  return std::adjacent_find(begin, end, [](const TracePoint& a, const TracePoint& b) {
    return !same_setpoint(a, b) ||
           std::abs(a.joint_temperature_C - b.joint_temperature_C) > kTemperatureJump_C;
  });
}

/// Adds one stretch and the number of its steady samples. Returns the number of torque sign changes in its steady part.
long add_stretch(Iterator begin, Iterator end, double origin_rad, LoopStatistics& result,
                 long& steady_samples) {
  const double direction = sign(begin->setpoint_position_rad - origin_rad);
  const auto length = end - begin;
  const auto steady =
      end - std::max<std::ptrdiff_t>(1, std::lround(kSteadyFraction * static_cast<double>(length)));
  long changes = 0;
  double last_sign = 0.0;
  for (auto point = begin; point != end; ++point) {
    result.overshoot_rad = std::max(result.overshoot_rad, -direction * error_rad(*point));
    if (point < steady) continue;
    ++steady_samples;
    result.steady_error_rad = std::max(result.steady_error_rad, std::abs(error_rad(*point)));
    const double torque_sign = sign(point->wanted_torque_Nm);
    if (torque_sign * last_sign < 0.0) ++changes;
    if (torque_sign != 0.0) last_sign = torque_sign;
  }
  return changes;
}

void evaluate_first_step(const std::vector<TracePoint>& trace, LoopStatistics& result) {
  const auto end = std::find_if(trace.begin(), trace.end(),
                                [&](const TracePoint& p) { return !same_setpoint(p, trace.front()); });
  const double step_rad = std::abs(error_rad(trace.front()));
  const double direction = sign(error_rad(trace.front()));
  const auto risen = std::find_if(
      trace.begin(), end, [&](const TracePoint& p) { return direction * error_rad(p) <= 0.1 * step_rad; });
  if (risen != end) result.rise_time_s = risen->time_s;
  auto settled = end;
  while (settled != trace.begin() && std::abs(error_rad(*(settled - 1))) <= 0.02 * step_rad) --settled;
  if (settled != end) result.settling_time_s = settled->time_s;
}

}  // namespace

std::vector<TracePoint> on_the_link(std::vector<TracePoint> trace) {
  for (TracePoint& point : trace) point.joint_position_rad = point.link_position_rad;
  return trace;
}

LoopStatistics evaluate(const std::vector<TracePoint>& trace, double period_s) {
  LoopStatistics result;
  if (trace.empty()) return result;
  for (const TracePoint& point : trace) {
    const double e = error_rad(point);
    result.pi1_rad2 += e * e;
    result.pi2 += std::abs(e / point.setpoint_position_rad);
    result.peak_torque_Nm = std::max(result.peak_torque_Nm, std::abs(point.applied_torque_Nm));
  }
  result.final_error_rad = error_rad(trace.back());

  long changes = 0;
  long steady_samples = 0;
  double origin_rad = trace.front().joint_position_rad;
  for (auto begin = trace.begin(); begin != trace.end();) {
    const auto last = stretch_end(begin, trace.end());
    const auto end = last == trace.end() ? last : last + 1;
    changes += add_stretch(begin, end, origin_rad, result, steady_samples);
    // A jump of temperature is no step: overshoot still refers to the position at the last change of setpoint.
    if (end != trace.end() && !same_setpoint(*begin, *end)) origin_rad = end->joint_position_rad;
    begin = end;
  }
  result.steady_sign_changes_per_s =
      static_cast<double>(changes) / (static_cast<double>(steady_samples) * period_s);
  evaluate_first_step(trace, result);
  return result;
}

bool simulate(const ClosedLoopConfig& config, LoopController& controller,
              const std::function<void(const TracePoint&)>& visit) {
  const std::size_t count = sample_count(config);
  JointPlant plant(config.plant);
  const bool exact = config.plant.encoder.counts_per_joint_revolution <= 0.0;
  controller.reset();
  for (std::size_t k = 0; k < count; ++k) {
    const double time_s = static_cast<double>(k) * config.plant.period_s;
    plant.set_ambient_temperature(config.ambient.at(time_s));
    const JointState state = plant.state();
    const double link_rad = plant.link_state().position_rad;
    LoopSample sample;
    sample.time_s = time_s;
    sample.setpoint_position_rad = config.setpoint_rad.at(time_s);
    sample.joint_position_rad = plant.measured_position_rad();
    if (exact) sample.joint_velocity_rad_s = plant.feedback_state().velocity_rad_s;
    sample.temperature_C = plant.sensor_temperature_C();
    sample.torque_applied_Nm = plant.applied_torque_Nm();
    const double torque_Nm = controller.torque_Nm(sample);
    const double joint_temperature_C = plant.joint_temperature_C();
    plant.step(torque_Nm, config.load_torque_Nm.at(time_s));
    visit({time_s, sample.setpoint_position_rad, state.position_rad, state.velocity_rad_s, torque_Nm,
           plant.applied_torque_Nm(), joint_temperature_C, link_rad});
    if (!(std::abs(plant.state().position_rad) < kLargestPosition_rad)) return false;
  }
  return true;
}

ClosedLoopResult run_closed_loop(const ClosedLoopConfig& config, LoopController& controller) {
  ClosedLoopResult result;
  result.trace.reserve(sample_count(config));
  result.diverged = !simulate(config, controller, [&](const TracePoint& point) {
    result.trace.push_back(point);
    if (controller.switched_off() && !result.switched_off_s) result.switched_off_s = point.time_s;
  });
  result.statistics = evaluate(result.trace, config.plant.period_s);
  if (result.diverged)
    result.statistics.pi1_rad2 = result.statistics.pi2 = std::numeric_limits<double>::infinity();
  return result;
}

}  // namespace strainwave
