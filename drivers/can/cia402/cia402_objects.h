// SPDX-License-Identifier: BSD-3-Clause
// Objects of the drive profile (CiA 402-2) that several files use.
#pragma once

#include "drivers/can/canopen/canopen_sdo.h"

namespace strainwave::cia402 {

inline constexpr canopen::Entry kDeviceType{0x1000, 0};  // CiA 301
inline constexpr canopen::Entry kControlword{0x6040, 0};
inline constexpr canopen::Entry kStatusword{0x6041, 0};
inline constexpr canopen::Entry kQuickStopOption{0x605A, 0};
inline constexpr canopen::Entry kModeDisplay{0x6061, 0};
inline constexpr canopen::Entry kTargetTorque{0x6071, 0};
inline constexpr canopen::Entry kRatedTorque{0x6076, 0};
inline constexpr canopen::Entry kTargetPosition{0x607A, 0};
inline constexpr canopen::Entry kTorqueOffset{0x60B2, 0};
inline constexpr canopen::Entry kVelocityUnit{0x60A9, 0};
inline constexpr canopen::Entry kPositionOffset{0x60B0, 0};
inline constexpr canopen::Entry kVelocityOffset{0x60B1, 0};
inline constexpr canopen::Entry kInterpolatedTarget{0x60C1, 1};
inline constexpr canopen::Entry kTargetVelocity{0x60FF, 0};
inline constexpr canopen::Entry kProbeFunction{0x60B8, 0};

}  // namespace strainwave::cia402
