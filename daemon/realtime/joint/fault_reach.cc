// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/joint/fault_reach.h"

#include "lcmtypes/reading_doubt.h"

namespace strainwave {

OthersStop others_stop(Fault fault, std::uint32_t drive_error) noexcept {
  switch (fault) {
    // A sensor that is stuck and a joint that is blocked look the same.
    case Fault::kImplausibleReading:
      return drive_error >> 24U == static_cast<std::uint32_t>(ReadingDoubt::kStuck) ? OthersStop::kAtOnce
                                                                                    : OthersStop::kAlongPath;
    // The joint's own parts.
    case Fault::kNone:
    case Fault::kReadFailed:
    case Fault::kWriteRefused:
    case Fault::kDriveFault:
    case Fault::kStartTimeout:
    case Fault::kTemperatureLimit:
    case Fault::kGroup:
    case Fault::kHomingFailed:
    case Fault::kLimitSwitch:
    case Fault::kTemperatureLost:
    case Fault::kChatter:
      return OthersStop::kAlongPath;
    // Shared with other joints (supply, bus, time, the law), in the joint's way, or new.
    default:
      return OthersStop::kAtOnce;
  }
}

}  // namespace strainwave
