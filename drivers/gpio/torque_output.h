// SPDX-License-Identifier: BSD-3-Clause
// Converts a torque into a PWM duty, within the limits of the amplifier. Pure, real-time safe. Joint side.
// Source of the motor's torque-speed line: control/joint/motor_limits.h.
//
// The amplifier makes a current from the duty:
//   T = full scale * share
// The bridge makes a voltage, inductance neglected:
//   T = stall * share - slope * w
// `share` runs from -1 to 1 and becomes a duty:
//   sign-magnitude:      duty = min + |share| (max - min), a line tells the direction, idle is min
//   locked anti-phase:   duty = middle + share (max - min) / 2, idle is the middle
#pragma once

#include <cstdint>

#include "control/joint/motor_limits.h"

namespace strainwave {

enum class AmplifierKind { kCurrent, kVoltage };
enum class BridgeKind { kSignMagnitude, kLockedAntiphase };

struct TorqueOutputConfig {
  AmplifierKind amplifier = AmplifierKind::kCurrent;
  BridgeKind bridge = BridgeKind::kSignMagnitude;
  double full_scale_Nm = 0.0;  ///< kCurrent: torque at the largest duty, > 0
  MotorLimits motor;           ///< kVoltage: its stall torque, finite, and its slope
  double duty_min = 0.0;       ///< 0 <= duty_min < duty_max <= 1
  double duty_max = 1.0;
  double slew_Nm_s = 0.0;    ///< limit of the rate of change; 0: no limit
  double dead_time_s = 0.0;  ///< time without torque before the direction line changes
  double period_s = 0.001;
  bool reversed = false;  ///< positive torque needs negative share
};

class TorqueOutput {
 public:
  struct Output {
    double duty = 0.0;
    bool negative = false;           ///< level of the direction line
    double torque_applied_Nm = 0.0;  ///< torque that this output produces
  };

  explicit TorqueOutput(const TorqueOutputConfig& config) noexcept;

  /// Advances by one period.
  Output step(double torque_Nm, double joint_velocity_rad_s) noexcept;
  /// Sets zero torque at once, without the slew limit; the direction line keeps its level.
  Output idle() noexcept;
  double idle_duty() const noexcept;

 private:
  double share_of(double torque_Nm, double joint_velocity_rad_s) const noexcept;
  double torque_of(double share, double joint_velocity_rad_s) const noexcept;
  double limit_slew(double torque_Nm) noexcept;
  double limited(double duty) const noexcept;

  TorqueOutputConfig config_;
  std::int64_t dead_periods_;
  double torque_Nm_ = 0.0;  ///< after the slew limit
  bool negative_ = false;
  std::int64_t waited_periods_ = 0;  ///< since a change of direction was requested
};

}  // namespace strainwave
