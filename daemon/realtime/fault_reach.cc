#include "daemon/realtime/fault_reach.h"

#include "lcmtypes/reading_doubt.h"

namespace strainwave {

OthersStop others_stop(Fault fault, std::uint32_t drive_error) noexcept {
  switch (fault) {
    // A sensor that is stuck and a joint that is blocked look the same.
    case Fault::kImplausibleReading:
      return drive_error >> 24U == static_cast<std::uint32_t>(ReadingDoubt::kStuck) ? OthersStop::kAtOnce
                                                                                    : OthersStop::kAlongPath;
    // Shared with other joints: supply, bus, time, the law.
    case Fault::kPowerLost:
    case Fault::kLinkLost:
    case Fault::kEmergencyStop:
    case Fault::kDriveRestarted:
    case Fault::kBusError:
    case Fault::kNotFinite:
    case Fault::kOverruns:
    case Fault::kLoopStalled:
    case Fault::kPeriodsMissed:
    // Something is in the joint's way, or moves it.
    case Fault::kStopTimeout:
    case Fault::kPositionLimit:
    case Fault::kSpeedLimit:
    case Fault::kFollowingError:
    case Fault::kBlocked:
    case Fault::kOverload:
      return OthersStop::kAtOnce;
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
  }
  return OthersStop::kAtOnce;
}

}  // namespace strainwave
