// SPDX-License-Identifier: BSD-3-Clause
// The published record of one joint's cycle, by pure functions. Real-time safe.
#pragma once

#include <cstdint>
#include <optional>

#include "control/joint_controller.h"
#include "daemon/gateway/shared_memory.h"
#include "daemon/realtime/cycle_time.h"
#include "daemon/realtime/flight_recorder.h"
#include "daemon/realtime/friction_history.h"
#include "daemon/realtime/joint_mode.h"
#include "daemon/realtime/joint_zero.h"
#include "daemon/realtime/ordered_target.h"
#include "daemon/realtime/orders.h"
#include "daemon/realtime/temperature_check.h"
#include "drivers/actuator.h"

namespace strainwave {

/// All that a record is made of. Positions of reading, motion and target are the drive's; a record has the joint's.
struct JointCycle {
  const CycleTime& time;
  const JointMode& mode;
  const ActuatorReading& reading;
  const JointStep& motion;
  const JointZero& zero;
  const OrderedTarget& ordered;
  const TemperatureCheck& temperature;
  const TemperatureWeights& weights;
  double target_rad = 0.0;                        ///< of the controller
  double joint_velocity_rad_s = 0.0;              ///< measured or estimated, controlled or not
  std::int64_t table_id = 0;                      ///< 0: none
  std::int64_t friction_rules_id = 0;             ///< of the table; 0: none
  const FuzzyFriction* friction_rules = nullptr;  ///< of the table; null: none
  std::int32_t notices = 0;
  std::optional<double> inertia_kgm2{};  ///< as far as motions have shown it
  std::optional<Yield> yield{};          ///< to be published
  LearnedFriction learned{};
  double friction_factor = 1.0;  ///< at the present temperature
  FrictionHistory friction{};
  std::int64_t late_samples = 0;  ///< of streams, since the start
};

/// Every field but joint_index and those that the gateway adds (utime, session_id, challenge, owner_id, lease_s).
void fill_record(const JointCycle& cycle, StateRecord& record) noexcept;

/// The same cycle for the flight recorder.
FlightSample flight_sample(const StateRecord& record, const CycleTime& time, DriveState drive_state,
                           bool reading_fresh) noexcept;

}  // namespace strainwave
