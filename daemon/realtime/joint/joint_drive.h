// SPDX-License-Identifier: BSD-3-Clause
// The loop's view of one joint's drive: its checked readings, and its commands. Real-time safe; time is an argument. Positions are
// as the drive counts them. Without a fresh, finite position the joint continues for a few periods with an extrapolated one.
#pragma once

#include <cmath>
#include <memory>

#include "daemon/realtime/joint/joint_loop_config.h"
#include "daemon/realtime/joint/position_check.h"
#include "daemon/realtime/joint/temperature_check.h"
#include "daemon/realtime/loop/cycle_time.h"
#include "drivers/actuator.h"
#include "drivers/faulty_actuator.h"

namespace strainwave {

class JointDrive {
 public:
  /// Not real-time safe.
  JointDrive(const JointLoopConfig& config, std::unique_ptr<Actuator> actuator);

  /// Reads one period. `controlled`: the control law moves the joint, at `velocity_rad_s` by its own estimate. An implausible position
  /// becomes the fault kImplausible, unless the drive reports a fault itself. drive_error then gives the cause (lcmtypes/reading_doubt.h),
  /// also if the drive itself reports kImplausible.
  void read(bool controlled, double velocity_rad_s, const CycleTime& time) noexcept;
  void write(const ActuatorCommand& command) noexcept { actuator_->write(command); }
  /// Zero torque and disable, at once.
  void stop() noexcept { actuator_->stop(); }
  /// Also resets the count of missed positions.
  void clear_fault() noexcept;
  /// Returns false if this drive takes no injected faults.
  bool inject(const Injection& injection) noexcept;
  /// Inertia and largest static friction of the joint, by which positions are checked.
  void set_joint(double inertia_kgm2, double static_friction_Nm) noexcept {
    position_check_.set_joint(inertia_kgm2, static_friction_Nm);
  }

  const ActuatorReading& reading() const noexcept { return reading_; }
  double position_rad() const noexcept { return reading_.joint_position_rad; }
  /// From the drive; otherwise the mean over some 20 ms from positions, while the control law does not run. 0 below the speed
  /// that a flickering count would show.
  double velocity_rad_s() const noexcept {
    if (reading_.has_velocity) return reading_.joint_velocity_rad_s;
    return std::abs(velocity_rad_s_) > slowest_rad_s_ ? velocity_rad_s_ : 0.0;
  }
  /// Whether there is a position of this period.
  bool fresh() const noexcept { return fresh_; }
  bool missed() const noexcept { return missed_ > 0; }
  /// Whether too many periods in a row, skipped ones included, had no position. True before the first position.
  bool too_many_missed() const noexcept { return missed_ > missed_limit_; }
  /// From the sampling of the position to its arrival, ns; 0: unknown, or no position.
  std::int64_t position_delay_ns() const noexcept { return fresh_ ? reading_.position_delay_ns : 0; }
  const TemperatureCheck& temperature() const noexcept { return temperature_; }

 private:
  void go_on_without(double last_position_rad, double moved_rad) noexcept;
  void doubt(const ActuatorReading& reading, bool driven, const CycleTime& time) noexcept;

  std::unique_ptr<Actuator> actuator_;
  FaultyActuator* injector_;  ///< the same object when it takes injected faults, else null
  PositionCheck position_check_;
  TemperatureCheck temperature_;
  ActuatorReading reading_;
  double period_s_;
  double slowest_rad_s_;
  double velocity_rad_s_ = 0.0;  ///< from positions, while the joint is not under control
  bool fresh_ = false;
  int missed_limit_;
  int missed_;  ///< periods in a row, at most limit + 1; begins there, as no reading has come
};

}  // namespace strainwave
