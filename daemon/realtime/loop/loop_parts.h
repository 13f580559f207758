// SPDX-License-Identifier: BSD-3-Clause
// The parts of the loop: its settings, the buses, and for each joint a drive with its settings. daemon/assembly.h makes them from the
// configuration. Not real-time.
#pragma once

#include <memory>
#include <vector>

#include "daemon/realtime/joint/joint_loop.h"
#include "daemon/realtime/loop/flight_recorder.h"
#include "daemon/realtime/loop/overrun_watch.h"
#include "drivers/actuator.h"
#include "drivers/fieldbus.h"

namespace strainwave {

/// What to do when the system refuses real-time scheduling or memory locking.
enum class RealTimePolicy { kEnforce, kIgnore };

struct LoopConfig {
  double period_s = 0.001;
  RealTimePolicy real_time = RealTimePolicy::kEnforce;
  int priority = 80;  ///< SCHED_FIFO
  int cpu = -1;       ///< processor for the thread; -1: any
  OverrunLimits overruns;
  double state_rate_Hz = 200.0;
};

struct JointParts {
  JointLoopConfig config;
  std::unique_ptr<Actuator> actuator;
  std::unique_ptr<FlightRecorder> recorder;  ///< null: nothing is recorded
};

struct LoopParts {
  std::vector<std::unique_ptr<Fieldbus>> buses;  ///< the joints' drives may refer to them
  std::vector<JointParts> joints;
};

}  // namespace strainwave
