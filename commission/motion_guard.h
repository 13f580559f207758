// SPDX-License-Identifier: BSD-3-Clause
// Limits of a joint during commissioning. The guard checks every reading; the excitation brakes and stops on its findings. Joint side, SI.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "drivers/actuator.h"

namespace strainwave {

/// All finite, except the temperature; min < max, the others > 0.
struct ExcitationLimits {
  double position_min_rad = 0.0;
  double position_max_rad = 0.0;
  double speed_rad_s = 0.0;
  double acceleration_rad_s2 = 0.0;  ///< of the planned motion
  double torque_Nm = 0.0;
  double temperature_C = std::numeric_limits<double>::infinity();
};

/// Speed as a mean over periods.
class MeanSpeed {
 public:
  MeanSpeed(double period_s, std::size_t periods) : period_s_(period_s), positions_rad_(periods) {}
  double step(double position_rad);

 private:
  double period_s_;
  std::vector<double> positions_rad_;  ///< ring buffer
  std::size_t count_ = 0;
};

class MotionGuard {
 public:
  MotionGuard(const ExcitationLimits& limits, double period_s) : limits_(limits), period_s_(period_s) {}

  /// Returns the problem of this period, its position and what is allowed; nothing while all is well. `enabled`: torque is ordered.
  std::optional<std::string> judge(const ActuatorReading& reading, double speed_rad_s, bool enabled);

  /// True if the last reading's position is not plausible. The joint must then not be braked by feedback.
  bool blind() const { return blind_; }

  const ExcitationLimits& limits() const { return limits_; }

  /// Longest wait for a drive that is not ready after its enable, and for a missing position.
  static constexpr int kEnablePeriods = 5000;
  static constexpr int kMissingPeriods = 4;

 private:
  std::optional<std::string> judge_position(const ActuatorReading& reading);

  ExcitationLimits limits_;
  double period_s_;
  std::optional<double> last_position_rad_;
  bool blind_ = false;
  bool was_enabled_ = false;
  int enabling_periods_ = 0;
  int missing_periods_ = 0;
};

}  // namespace strainwave
