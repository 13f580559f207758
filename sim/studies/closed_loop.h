// SPDX-License-Identifier: BSD-3-Clause
// The closed loop without real time: a controller against the plant over a reference and a temperature
// profile, and the paper's performance indices. Offline. Source: Zhao (2006), chapter 6; docs/theory.md, "Scenarios".
//
// Sample k at t = k ts: the controller sees the measurement and the setpoint of t; its torque acts over
// [t, t + ts) after the plant's own delay and limits. With the true position:
//   e_k = r(t_k) - theta(t_k)
//   PI1 = sum e_k^2,   PI2 = sum |e_k / r_k|,   the initial transient included.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "sim/joint/joint_plant.h"
#include "sim/joint/temperature_profile.h"

namespace strainwave {

/// The information that a controller gets at one sample, joint side.
struct LoopSample {
  double time_s = 0.0;
  double setpoint_position_rad = 0.0;
  double joint_position_rad = 0.0;             ///< as measured
  std::optional<double> joint_velocity_rad_s;  ///< exact; only with an ideal encoder
  double temperature_C = 0.0;                  ///< as the sensor shows it; NaN: not known
  double torque_applied_Nm = 0.0;              ///< over the period that ends now
};

/// Interface of every controller that closes the loop.
class LoopController {
 public:
  virtual ~LoopController() = default;
  LoopController() = default;
  LoopController(const LoopController&) = delete;
  LoopController& operator=(const LoopController&) = delete;
  /// Torque wanted for this sample, N.m at the joint.
  virtual double torque_Nm(const LoopSample& sample) noexcept = 0;
  /// Forgets everything; called before each run.
  virtual void reset() noexcept = 0;
  /// Returns whether the controller has found the joint oscillating since reset(), and gives no torque any more.
  virtual bool switched_off() const noexcept { return false; }
};

struct ClosedLoopConfig {
  JointPlantConfig plant;
  TemperatureProfile ambient;
  TimeProfile setpoint_rad;
  TimeProfile load_torque_Nm;  ///< opposes positive motor torque
  double duration_s = 0.0;     ///< > 0
};

/// One sample of a run: true state of motor side and link at its start, the torque wanted there, and the torque applied over it.
struct TracePoint {
  double time_s, setpoint_position_rad, joint_position_rad, joint_velocity_rad_s, wanted_torque_Nm,
      applied_torque_Nm, joint_temperature_C;
  double link_position_rad;  ///< for a rigid joint, the joint's position
};

/// Performance figures of a trace. A stretch is a run of samples with one setpoint and without a jump of
/// temperature. Its last fifth counts as steady.
struct LoopStatistics {
  double pi1_rad2 = 0.0;
  double pi2 = 0.0;
  double final_error_rad = 0.0;            ///< at the last sample, with its sign
  double steady_error_rad = 0.0;           ///< largest |e| while steady
  double overshoot_rad = 0.0;              ///< farthest past a setpoint, in the direction of its step
  double rise_time_s = -1.0;               ///< 90 % of the first step reached; -1: never
  double settling_time_s = -1.0;           ///< |e| <= 2 % of the first step until its end; -1: never
  double peak_torque_Nm = 0.0;             ///< applied
  double steady_sign_changes_per_s = 0.0;  ///< of the wanted torque, while steady
};

struct ClosedLoopResult {
  LoopStatistics statistics;
  std::vector<TracePoint> trace;         ///< every sample
  std::optional<double> switched_off_s;  ///< when the controller found the joint oscillating
  bool diverged = false;  ///< left +-1e6 rad or became NaN; the indices are then infinite, the trace short
};

/// Runs `controller` from rest at the plant's initial position, and calls `visit` with every sample. Returns
/// false if the run diverged and ended early. Throws InputError for a bad configuration.
bool simulate(const ClosedLoopConfig& config, LoopController& controller,
              const std::function<void(const TracePoint&)>& visit);

/// Runs the loop in the same way and keeps the whole trace.
ClosedLoopResult run_closed_loop(const ClosedLoopConfig& config, LoopController& controller);

/// Returns the trace with the link's position in place of the motor's.
std::vector<TracePoint> on_the_link(std::vector<TracePoint> trace);

/// Statistics of a trace with one point per `period_s`.
LoopStatistics evaluate(const std::vector<TracePoint>& trace, double period_s);

}  // namespace strainwave
