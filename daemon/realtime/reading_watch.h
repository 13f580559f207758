// SPDX-License-Identifier: BSD-3-Clause
// What the joint goes on with when a drive has spoken: a position that is fresh and can be true, or, for a few periods, where the
// joint must be by now. Real-time safe; time is an argument.
#pragma once

#include <cstdint>

#include "daemon/realtime/cycle_time.h"
#include "daemon/realtime/position_check.h"
#include "drivers/actuator.h"
#include "lcmtypes/reading_doubt.h"

namespace strainwave {

class ReadingWatch {
 public:
  /// Up to `missed_limit` periods in a row, those that the loop left out included, may pass without a fresh position.
  ReadingWatch(const PositionCheckConfig& position, int missed_limit) noexcept
      : position_check_(position),
        period_s_(position.period_s),
        missed_limit_(missed_limit),
        missed_(missed_limit + 1) {}

  /// Inertia and the largest static friction of the joint, of its gain table.
  void set_joint(double inertia_kgm2, double static_friction_Nm) noexcept {
    position_check_.set_joint(inertia_kgm2, static_friction_Nm);
  }
  /// One period's reading. `controlled`: the control law moved the joint, at `velocity_rad_s` by its own estimate. A fresh
  /// position that cannot be true becomes the fault kImplausible, unless the drive has one of its own. With it, drive_error says which
  /// of its causes it was (lcmtypes/reading_doubt.h), for the drive's own finding too.
  const ActuatorReading& take(const ActuatorReading& reading, bool controlled, double velocity_rad_s,
                              const CycleTime& time) noexcept;
  /// Begins to count missed positions anew.
  void forgive() noexcept { missed_ = 0; }

  const ActuatorReading& reading() const noexcept { return reading_; }
  bool fresh() const noexcept { return freshness_ == Freshness::kFresh; }
  bool missed() const noexcept { return missed_ > 0; }
  /// Also before the first position.
  bool too_many_missed() const noexcept { return missed_ > missed_limit_; }

 private:
  enum class Freshness {
    kNone,       ///< no position this period
    kMalformed,  ///< one that is no number, or with a velocity or torque that is none
    kFresh
  };
  static Freshness judge(const ActuatorReading& reading) noexcept;
  static ReadingDoubt not_finite(const ActuatorReading& reading) noexcept;

  PositionCheck position_check_;
  double period_s_;
  int missed_limit_;
  ActuatorReading reading_;
  Freshness freshness_ = Freshness::kNone;
  int missed_;  ///< periods in a row, counted to one beyond the limit, where it begins: no reading has come
};

}  // namespace strainwave
