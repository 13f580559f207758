// SPDX-License-Identifier: BSD-3-Clause
// What a commissioned joint may do. It judges every reading; the excitation brakes and stops where it finds something. Joint side, SI.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drivers/actuator.h"

namespace strainwave {

/// All finite; min < max, the others > 0.
struct ExcitationLimits {
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;  ///< of the planned motion
  double torque_Nm = 0.0;
};

/// Speed as a mean over periods.
class MeanSpeed {
 public:
  MeanSpeed(double period_s, std::size_t periods) : period_s_(period_s), positions_rad_(periods) {}
  double step(double position_rad);

 private:
  double period_s_;
  std::vector<double> positions_rad_;  ///< a ring
  std::size_t count_ = 0;
};

class MotionGuard {
 public:
  explicit MotionGuard(const ExcitationLimits& limits) : limits_(limits) {}

  /// What is wrong in this period, where, and what is allowed; nothing while all is well. `enabled` is whether torque is ordered.
  std::optional<std::string> judge(const ActuatorReading& reading, double speed_rad_s, bool enabled);

  const ExcitationLimits& limits() const { return limits_; }

  /// A drive that has not become ready after so many periods, or has sent no position for so many, is not waited for any longer.
  static constexpr int kEnablePeriods = 5000;
  static constexpr int kMissingPeriods = 4;

 private:
  ExcitationLimits limits_;
  bool was_enabled_ = false;
  int enabling_periods_ = 0;
  int missing_periods_ = 0;
};

}  // namespace strainwave
