// SPDX-License-Identifier: BSD-3-Clause
// Every fault that can be injected, with the reaction that docs/faults.md promises. The tests of the loop use
// this table, and another test compares the page with it.
#pragma once

#include <cstdint>
#include <ostream>
#include <string>
#include <vector>

#include "drivers/injected_fault.h"
#include "strainwave/vocabulary.h"

namespace strainwave::testing {

/// The joint's motion when the fault begins.
enum class Doing { kHolding, kMoving, kHoldingThenMoving };

/// The loop's reaction.
enum class Reaction {
  kFault,               ///< one of `faults` latches
  kTemperatureUnknown,  ///< temperature_status says why; the joint continues with the last valid one
  kNone,                ///< tolerated
};

struct InjectedFaultCase {
  std::string name;  ///< of the test
  Injection injection;
  Doing doing;
  Reaction reaction;
  std::vector<Fault> faults;
  std::int64_t within_cycles;  ///< from the first falsified reading (or the motion's order); how long to
                               ///< watch for kNone
};

inline void PrintTo(const InjectedFaultCase& entry, std::ostream* out) {
  *out << entry.name;
}

/// Limits of the joint for which the promises hold; docs/faults.md names them.
inline constexpr double kTableMaxAge_s = 1.0;

inline const std::vector<InjectedFaultCase>& injected_fault_table() {
  using K = InjectedFault;
  using D = Doing;
  using R = Reaction;
  static const std::vector<InjectedFaultCase> table{
      {"SensorStuckInMotion",
       {K::kSensorStuck},
       D::kMoving,
       R::kFault,
       {Fault::kImplausibleReading, Fault::kFollowingError, Fault::kSpeedLimit},
       30},
      {"SensorStuckAtRest",
       {K::kSensorStuck},
       D::kHoldingThenMoving,
       R::kFault,
       {Fault::kImplausibleReading, Fault::kFollowingError, Fault::kSpeedLimit},
       30},
      {"SensorNanInMotion", {K::kSensorNan}, D::kMoving, R::kFault, {Fault::kImplausibleReading}, 1},
      {"SensorNanAtRest", {K::kSensorNan}, D::kHolding, R::kFault, {Fault::kImplausibleReading}, 1},
      {"SensorVeryNoisy",
       {K::kSensorNoisy, 0, 0, 0.02},
       D::kHolding,
       R::kFault,
       {Fault::kImplausibleReading, Fault::kSpeedLimit},
       20},
      {"SensorNoisyByOneCount", {K::kSensorNoisy, 0, 0, 2e-5}, D::kMoving, R::kNone, {}, 2000},
      {"SensorMuchDelayed",
       {K::kSensorDelayed, 0, 0, 0.05},
       D::kMoving,
       R::kFault,
       {Fault::kImplausibleReading, Fault::kFollowingError, Fault::kSpeedLimit},
       100},
      {"SensorDelayedByOnePeriod", {K::kSensorDelayed, 0, 0, 0.001}, D::kHolding, R::kNone, {}, 2000},
      {"SensorJumpAtRest",
       {K::kSensorJump, 0, 0, 0.05},
       D::kHolding,
       R::kFault,
       {Fault::kImplausibleReading},
       1},
      {"SensorJumpInMotion",
       {K::kSensorJump, 0, 0, -0.05},
       D::kMoving,
       R::kFault,
       {Fault::kImplausibleReading},
       1},
      {"SensorSmallJump", {K::kSensorJump, 0, 0, 0.01}, D::kHolding, R::kFault, {Fault::kSpeedLimit}, 20},
      {"TemperatureLost", {K::kTemperatureLost}, D::kMoving, R::kTemperatureUnknown, {}, 1001},
      {"TemperatureStuck", {K::kTemperatureStuck}, D::kHolding, R::kNone, {}, 2000},
      {"TemperatureDriftingFast",
       {K::kTemperatureDrifting, 0, 0, 40.0},
       D::kHolding,
       R::kTemperatureUnknown,
       {},
       600},
      {"TemperatureDriftingSlowly",
       {K::kTemperatureDrifting, 0, 0, 10.0},
       D::kHolding,
       R::kFault,
       {Fault::kTemperatureLimit},
       5700},
      {"WriteRefused", {K::kWriteRefused}, D::kMoving, R::kFault, {Fault::kWriteRefused}, 2},
      {"Overrun", {K::kOverrun, 0, 0, 0.0025}, D::kMoving, R::kFault, {Fault::kPeriodsMissed}, 170},
      {"SlowRead", {K::kSlowRead, 0, 0, 0.0025}, D::kMoving, R::kFault, {Fault::kPeriodsMissed}, 170},
      {"SlowReadWithinThePeriod", {K::kSlowRead, 0, 0, 0.0002}, D::kMoving, R::kNone, {}, 2000},
      {"PowerLostInMotion", {K::kPowerLost}, D::kMoving, R::kFault, {Fault::kPowerLost}, 1},
      {"PowerLostAtRest", {K::kPowerLost}, D::kHolding, R::kFault, {Fault::kPowerLost}, 1},
  };
  return table;
}

}  // namespace strainwave::testing
