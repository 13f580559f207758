// SPDX-License-Identifier: BSD-3-Clause
#include "sim/studies/time_optimal.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/input_error.h"
#include "base/printable.h"
#include "base/units.h"
#include "sim/joint/root.h"

namespace strainwave {

namespace {

struct Stop {
  double position_rad = 0.0;
  double duration_s = 0.0;  ///< since the move began
};

/// One move from rest, beginning at sample `first`.
class Move {
 public:
  Move(const ClosedLoopConfig& config, std::size_t first, double from_rad, double to_rad)
      : config_(config),
        first_(first),
        from_rad_(from_rad),
        to_rad_(to_rad),
        direction_(sign(to_rad - from_rad)) {}

  /// Returns where and when the joint stops if the torque reverses `switch_s` after the start. Adds the true
  /// state at each sample to `trace`, if there is one.
  Stop simulate(double switch_s, std::vector<TracePoint>* trace) const {
    JointState state{from_rad_, 0.0, true};
    const double period_s = config_.plant.period_s;
    for (std::size_t k = 0;; ++k) {
      const double begin_s = static_cast<double>(k) * period_s;
      const double drive_s = std::clamp(switch_s - begin_s, 0.0, period_s);
      if (trace != nullptr)
        trace->push_back(sample(first_ + k, state, drive_s > 0.0 ? direction_ : -direction_));
      if (drive_s > 0.0)
        advance(state, config_.plant.joint, input(first_ + k, direction_), drive_s, substeps());
      const double brake_s = period_s - drive_s;
      if (brake_s <= 0.0) continue;
      const JointInput brake = input(first_ + k, -direction_);
      JointState after = state;
      advance(after, config_.plant.joint, brake, brake_s, substeps());
      if (direction_ * after.velocity_rad_s <= 0.0) return stop(state, brake, brake_s, begin_s + drive_s);
      state = after;
    }
  }

  /// The switching instant for which the move ends on the setpoint. A move longer than `longest_s` keeps full torque until then.
  double switching_time_s(double longest_s) const {
    const JointInput start = input(first_, direction_);
    if (!(direction_ * (start.torque_Nm - start.load_torque_Nm) > start.friction.static_Nm))
      throw InputError("time-optimal motion", "peak_torque_Nm",
                       number_text(config_.plant.motor.peak_torque_Nm),
                       "must exceed static friction and load, or the joint cannot move");
    const auto miss_rad = [&](double switch_s) {
      return direction_ * (simulate(switch_s, nullptr).position_rad - to_rad_);
    };
    double high_s = config_.plant.period_s;
    while (miss_rad(high_s) < 0.0) {
      if (high_s >= longest_s) return longest_s;
      high_s = std::min(2.0 * high_s, longest_s);
    }
    return find_rising_root(miss_rad, 0.0, high_s, 1e-13 * std::abs(to_rad_ - from_rad_));
  }

 private:
  int substeps() const { return config_.plant.substeps; }

  JointInput input(std::size_t k, double torque_sign) const {
    const double time_s = static_cast<double>(k) * config_.plant.period_s;
    return {torque_sign * config_.plant.motor.peak_torque_Nm, config_.load_torque_Nm.at(time_s),
            config_.plant.joint.friction.at(config_.ambient.at(time_s)), config_.plant.motor};
  }

  TracePoint sample(std::size_t k, const JointState& state, double torque_sign) const {
    const double time_s = static_cast<double>(k) * config_.plant.period_s;
    const double torque_Nm =
        config_.plant.motor.limit_Nm(torque_sign * config_.plant.motor.peak_torque_Nm, state.velocity_rad_s);
    return {time_s,    config_.setpoint_rad.at(time_s), state.position_rad, state.velocity_rad_s, torque_Nm,
            torque_Nm, config_.ambient.at(time_s),      state.position_rad};
  }

  /// The stop within `brake_s` after `state`. After the stop the same torque would drive the joint back.
  Stop stop(const JointState& state, const JointInput& brake, double brake_s, double begin_s) const {
    const auto after = [&](double duration_s) {
      JointState result = state;
      if (duration_s > 0.0) advance(result, config_.plant.joint, brake, duration_s, substeps());
      return result;
    };
    const auto reversed_speed = [&](double duration_s) {
      return -direction_ * after(duration_s).velocity_rad_s;
    };
    const double stop_s = find_rising_root(reversed_speed, 0.0, brake_s, 1e-15);
    return {after(stop_s).position_rad, begin_s + stop_s};
  }

  const ClosedLoopConfig& config_;
  std::size_t first_;
  double from_rad_;
  double to_rad_;
  double direction_;
};

}  // namespace

TimeOptimalResult run_time_optimal(const ClosedLoopConfig& config) {
  const JointPlant checked(config.plant);
  if (!std::isfinite(config.plant.motor.peak_torque_Nm))
    throw InputError("time-optimal motion", "peak_torque_Nm", "infinite",
                     "must be finite: otherwise a move would take no time");
  const auto count = static_cast<std::size_t>(std::ceil(config.duration_s / config.plant.period_s - 1e-9));
  TimeOptimalResult result;
  result.trace.reserve(count);
  double position_rad = config.plant.initial_position_rad;
  while (result.trace.size() < count) {
    const std::size_t k = result.trace.size();
    const double time_s = static_cast<double>(k) * config.plant.period_s;
    const double setpoint_rad = config.setpoint_rad.at(time_s);
    if (setpoint_rad == position_rad) {
      result.trace.push_back(
          {time_s, setpoint_rad, position_rad, 0.0, 0.0, 0.0, config.ambient.at(time_s), position_rad});
      continue;
    }
    const Move move(config, k, position_rad, setpoint_rad);
    const double left_s = config.plant.period_s * static_cast<double>(count - k);
    const Stop stop = move.simulate(move.switching_time_s(left_s), &result.trace);
    if (k == 0 && stop.duration_s <= left_s) result.first_arrival_s = stop.duration_s;
    if (std::any_of(result.trace.begin() + static_cast<std::ptrdiff_t>(k), result.trace.end(),
                    [&](const TracePoint& point) { return point.setpoint_position_rad != setpoint_rad; }))
      throw InputError(
          "time-optimal motion", "setpoint_position_rad", number_text(setpoint_rad),
          "must hold until the move to it has ended, which takes " + number_text(stop.duration_s) + " s");
    position_rad = setpoint_rad;
  }
  result.trace.resize(count);
  result.statistics = evaluate(result.trace, config.plant.period_s);
  return result;
}

}  // namespace strainwave
