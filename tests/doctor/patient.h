// SPDX-License-Identifier: BSD-3-Clause
// Random joints, healthy or with one cause of trouble, and the record of the doctor's test motion in virtual time.
#pragma once

#include <string>
#include <vector>

#include "daemon/realtime/joint/joint_loop_config.h"
#include "doctor/evidence.h"
#include "drivers/injected_fault.h"
#include "drivers/simulated_actuator.h"
#include "tests/doctor/mistaken_drive.h"

namespace strainwave::testing {

struct Patient {
  JointLoopConfig loop;
  SimulatedActuatorConfig drive;
  Mistakes mistakes;
  std::vector<Injection> faults;
  ConfiguredJoint told;
  const GainTable* table = nullptr;
  unsigned seed = 0;
  // Errors of the daemon around the joint.
  double stall_share = 0.0;        ///< share of the cycles that come late by a stall
  std::int64_t stall_periods = 3;  ///< most periods that a stall leaves out; uniform from 1
  bool real_time = true;
  double clock_rate = 0.0;    ///< relative rate error of the sender's clock
  double clock_jump_s = 0.0;  ///< jump of that clock after 8 s
};

/// Joint number `index`, rigid or flexible, at -5 to 40 degC. Friction is within 15 % of the table's; torque ripple, hysteresis and heating
/// are simulated. `cause`: one of causes(), or empty for a healthy joint.
Patient random_patient(const std::string& cause, int index);

/// Enables the joint and runs the test motion, unless a fault ends it. `seconds`: duration in joint time.
Evidence examine(const Patient& patient, std::int64_t stride_periods, double& seconds);

}  // namespace strainwave::testing
