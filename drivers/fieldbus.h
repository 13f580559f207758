// SPDX-License-Identifier: BSD-3-Clause
// The seam for what joints share: a bus to several drives. The loop begins the bus's cycle before any joint
// reads and ends it after every joint wrote, so that a bus is emptied once for all and ends its period by one SYNC.
//
// Real-time rules as in actuator.h: making a bus may block, allocate and throw InputError; begin_cycle() and
// end_cycle() are called from the real-time thread and do none of it. Drives on no bus, as the simulated
// ones, need none.
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

  /// The drive in place `slot`, in the order of the configuration. It refers to this bus, which must outlive it.
  virtual std::unique_ptr<Actuator> make_actuator(std::size_t slot) = 0;
  /// Lines for the log since the last call: what was found and computed at start, and what happened since.
  /// May be called from another thread than the loop's.
  virtual std::vector<std::string> take_messages() { return {}; }

  /// After the last end_cycle(): leaves the drives in order. Blocks; not for the loop's thread. Nothing may follow it.
  virtual void close() {}

  /// Takes what has arrived. `now_ns` is CLOCK_MONOTONIC at the start of this period, the same as the joints get.
  virtual void begin_cycle(std::int64_t now_ns) noexcept = 0;
  /// Sends what belongs to all joints. Also called once after the last stop() of every joint.
  virtual void end_cycle() noexcept = 0;
};

}  // namespace strainwave
