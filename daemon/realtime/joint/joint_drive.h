// SPDX-License-Identifier: BSD-3-Clause
// The drive of one joint as the loop sees it: what it reads, judged, and what it is ordered. Real-time safe; time is an argument.
// Positions are the drive's. Where no position comes that is fresh and can be true, the joint goes on for a few periods with where it
// must be by now.
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

  /// One period. `controlled`: the control law moves the joint, at `velocity_rad_s` by its own estimate. A fresh position that cannot be true
  /// becomes the fault kImplausible, unless the drive has one of its own. With it, drive_error says which of its causes it was
  /// (lcmtypes/reading_doubt.h), for the drive's own finding too.
  void read(bool controlled, double velocity_rad_s, const CycleTime& time) noexcept;
  void write(const ActuatorCommand& command) noexcept { actuator_->write(command); }
  /// Zero torque and disable, at once.
  void stop() noexcept { actuator_->stop(); }
  /// Also begins to count missed positions anew.
  void clear_fault() noexcept;
  /// False: this drive takes no injected faults.
  bool inject(const Injection& injection) noexcept;
  /// Inertia and the largest static friction of the joint, of its gain table: what a position is judged by.
  void set_joint(double inertia_kgm2, double static_friction_Nm) noexcept {
    position_check_.set_joint(inertia_kgm2, static_friction_Nm);
  }

  const ActuatorReading& reading() const noexcept { return reading_; }
  double position_rad() const noexcept { return reading_.joint_position_rad; }
  /// By the drive, or else by positions in the mean of some 20 ms, as long as the control law does not run; 0 where a
  /// count that flickers shows as much.
  double velocity_rad_s() const noexcept {
    if (reading_.has_velocity) return reading_.joint_velocity_rad_s;
    return std::abs(velocity_rad_s_) > slowest_rad_s_ ? velocity_rad_s_ : 0.0;
  }
  /// There is a position of this period.
  bool fresh() const noexcept { return fresh_; }
  bool missed() const noexcept { return missed_ > 0; }
  /// Of periods in a row, those that the loop left out included. Also before the first position.
  bool too_many_missed() const noexcept { return missed_ > missed_limit_; }
  /// From the position's sampling until it came; 0: not known, or none came.
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
  double velocity_rad_s_ = 0.0;  ///< of a joint that is not under control, by positions
  bool fresh_ = false;
  int missed_limit_;
  int missed_;  ///< periods in a row, counted to one beyond the limit, where it begins: no reading has come
};

}  // namespace strainwave
