// SPDX-License-Identifier: BSD-3-Clause
// Random joints, healthy or with one cause of trouble, and what the doctor's test motion records of them in virtual time.
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
  // Of the daemon around it.
  double stall_share = 0.0;        ///< of the cycles, after which periods are left out
  std::int64_t stall_periods = 3;  ///< at most, evenly from one on
  bool real_time = true;
  double clock_rate = 0.0;    ///< of the sender's clock, share
  double clock_jump_s = 0.0;  ///< in the middle
};

/// The joint number `index`: rigid and flexible ones, -5 to 40 degC, friction within 15 % of the table's, with torque ripple, hysteresis
/// and heat. `cause`: of causes(), or empty for a healthy one.
Patient random_patient(const std::string& cause, int index);

/// Brings it to hold and through the test motion, or to the fault that ends it. `seconds`: of joint time.
Evidence examine(const Patient& patient, std::int64_t stride_periods, double& seconds);

}  // namespace strainwave::testing
