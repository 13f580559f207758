// SPDX-License-Identifier: BSD-3-Clause
// A simulated servo drive of the profile CiA 402 around the project's joint plant: power states, drive units, reactions to
// faults and to a lost connection. Its modes are torque (CST, TQ), and position and velocity with its own cascade (IP, CSP, CSV).
// It uses the object dictionary but no network. Each step() is one control period. Source: CiA 402-2 (IEC 61800-7-201).
#pragma once

#include <cstdint>
#include <functional>

#include "sim/joint/joint_plant.h"
#include "sim/joint/temperature_profile.h"
#include "tests/support/can_nodes/motion_loop.h"
#include "tests/support/can_nodes/object_dictionary.h"
#include "tests/support/can_nodes/power_state.h"

namespace strainwave::can_nodes {

/// Modes of operation, 6060h.
inline constexpr int kModeTorqueProfile = 4;
inline constexpr int kModeInterpolatedPosition = 7;
inline constexpr int kModeCyclicPosition = 8;
inline constexpr int kModeCyclicVelocity = 9;
inline constexpr int kModeCyclicTorque = 10;

/// Error codes of CiA 301 (table 26) and CiA 402 that the drive itself raises.
inline constexpr std::uint16_t kErrorHeartbeat = 0x8130;
inline constexpr std::uint16_t kErrorFollowing = 0x8611;
inline constexpr std::uint16_t kErrorPdoLength = 0x8210;
inline constexpr std::uint16_t kErrorRpdoTimeout = 0x8250;

struct TemperatureObject {
  Key key{0x3201, 1};
  DataType type = DataType::kInteger16;  ///< kInteger16 or kReal32
  double unit_C = 0.1;                   ///< of one count of an integer
};

struct ServoDriveConfig {
  JointPlantConfig plant;  ///< its encoder is set from counts_per_joint_revolution
  TemperatureProfile ambient;
  double counts_per_joint_revolution = 320000;  ///< of 6064h
  double rated_torque_Nm = 0.192;               ///< on the side that joint_torque_per_drive_torque implies
  double joint_torque_per_drive_torque =
      50.0;  ///< gear ratio, or 1 if the drive's torques are the joint's; < 0: reversed
  double rated_current_A = 1.0;
  double rated_torque_units_per_Nm = 1000.0;  ///< of 6076h: 1000 in the profile, 1e6 in some drives
  bool has_cst = true;
  bool has_tq = true;
  bool has_ip = false;
  bool has_csp = false;
  bool has_csv = false;
  double velocity_bandwidth_rad_s = 200.0;  ///< of its own velocity loop; the position loop has a quarter
  std::int64_t self_test_us = 20000;        ///< from power-on to Switch on disabled
  std::int64_t enable_delay_us = 10000;     ///< brake and current loop: Switched on to Operation enabled
  std::int64_t temperature_period_us = 100000;
  TemperatureObject temperature;
  double counts_per_index = 6400.0;  ///< of 6064h, between two index pulses; one is at 0
};

class ServoDrive {
 public:
  struct Events {
    std::function<void(PowerState from, PowerState to)> power_changed;
    std::function<void(std::uint16_t code)> error_raised;
    std::function<void()> error_reset;
    std::function<void()> at_rest;  ///< the joint is at rest after its power was removed
  };

  /// Adds its objects to `dictionary`. Throws InputError for an impossible plant.
  ServoDrive(const ServoDriveConfig& config, ObjectDictionary& dictionary, Events events);

  /// Power-on, or the profile's part of a reset. The joint keeps its position.
  void restart();
  /// Applies 6040h after it was written.
  void obey_controlword();
  /// At a SYNC: the ordered setpoint must be reached at the next SYNC.
  void take_setpoint(std::int64_t sync_period_us);
  /// One control period.
  void step();
  void raise_error(std::uint16_t code);
  /// Reacts as 6007h says, if the master is lost or takes the node out of operation.
  void lose_connection();

  PowerState power() const { return power_; }
  const JointPlant& plant() const { return plant_; }
  double torque_demand_Nm() const { return demand_Nm_; }
  std::int64_t period_us() const { return period_us_; }
  /// Sets the external torque on the joint from now on.
  void set_load_torque_Nm(double load_torque_Nm) { load_torque_Nm_ = load_torque_Nm; }

 private:
  void add_objects();
  void change_power(PowerState to);
  void advance_power();
  void react_to_fault();
  double target_torque_Nm();
  bool follows() const;
  double braking_torque_Nm() const;
  double limit_permille(std::uint16_t index) const;
  void show_state();
  void show_temperature();
  void probe_index(double counts_before, double counts_now);
  /// Direction of the drive relative to the joint: 1 or -1.
  double direction() const;
  double drive_counts() const;
  double joint_torque_per_permille() const;

  ServoDriveConfig config_;
  ObjectDictionary& dictionary_;
  Events events_;
  JointPlant plant_;
  std::int64_t period_us_;

  PowerState power_ = PowerState::kNotReadyToSwitchOn;
  std::uint16_t controlword_ = 0;
  std::int64_t in_state_us_ = 0;
  bool enabling_ = false;
  bool awaiting_rest_ = false;
  bool limited_ = false;
  double demand_Nm_ = 0.0;        ///< joint side
  double ramped_permille_ = 0.0;  ///< of TQ
  MotionLoop loop_;
  double velocity_counts_s_ = 0.0;  ///< the drive's estimate
  double load_torque_Nm_ = 0.0;
  std::int64_t since_temperature_us_ = 0;
};

}  // namespace strainwave::can_nodes
