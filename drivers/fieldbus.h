// SPDX-License-Identifier: BSD-3-Clause
// The interface of a bus that several drives share. The loop begins the bus cycle before any joint reads and ends it
// after every joint wrote. So the bus is emptied once for all joints, and each period ends with one SYNC.
//
// Real-time rules as in actuator.h: making a bus may block, allocate and throw InputError. The real-time
// thread calls begin_cycle() and end_cycle(), which do none of these. Drives without a bus, such as the
// simulated ones, need no Fieldbus.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/actuator.h"

namespace strainwave {

class Fieldbus {
 public:
  virtual ~Fieldbus() = default;
  Fieldbus() = default;
  Fieldbus(const Fieldbus&) = delete;
  Fieldbus& operator=(const Fieldbus&) = delete;

  /// Returns the drive at position `slot` of the configuration. The drive refers to this bus, which must outlive it.
  virtual std::unique_ptr<Actuator> make_actuator(std::size_t slot) = 0;
  /// Returns the log lines since the last call: results of the start-up, then later events. May be called
  /// from another thread than the loop's.
  virtual std::vector<std::string> take_messages() { return {}; }

  /// Leaves the drives disabled, after the last end_cycle(). Blocks, so the loop's thread must not call it. No call may follow it.
  virtual void close() {}

  /// Takes the frames that have arrived. `now_ns` is CLOCK_MONOTONIC at the start of this period, as for the joints.
  virtual void begin_cycle(std::int64_t now_ns) noexcept = 0;
  /// Sends the frames that concern all joints. Also called once after the last stop() of every joint.
  virtual void end_cycle() noexcept = 0;
};

}  // namespace strainwave
