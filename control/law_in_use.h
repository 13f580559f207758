// SPDX-License-Identifier: BSD-3-Clause
// The control law of the gain table in use. Real-time safe. Joint side, SI.
//
//   temperature       the last known one; before the first, the middle of the table's range
//   change of table   bumpless transfer: the new integral gives the next torque that the old gains would have given
//                       u'(x, integral') = u(x, integral)
//   count torque      torque step of one encoder count: resolution max_i (|F_i1| + |F_i2| share / period) (1 + n)
//   n                 the table's lead in periods, 0 on a rigid joint; it restarts after interrupt()
#pragma once

#include <optional>

#include "control/scheduled_controller.h"

namespace strainwave {

class LawInUse {
 public:
  /// `period_s` > 0; `encoder_resolution_rad` >= 0; `velocity_share` in (0, 1] is that of JointReading.
  LawInUse(double period_s, double encoder_resolution_rad, double velocity_share = 1.0) noexcept
      : period_s_(period_s),
        encoder_resolution_rad_(encoder_resolution_rad),
        velocity_share_(velocity_share) {}

  /// Takes a table that has passed find_defect().
  void load(const GainTable& table) noexcept;
  bool loaded() const noexcept { return loaded_; }
  /// Forgets everything except table and temperature.
  void begin_anew() noexcept;
  /// Returns true if the weights of the temperature rules have changed.
  bool set_temperature(double temperature_C) noexcept;

  /// One period. The first step after a change of table continues the old table's torque.
  ControllerOutput step(const ControllerInput& input) noexcept;
  /// Another torque than the law's is applied: the law's next torque continues no earlier one.
  void interrupt() noexcept {
    outgoing_.reset();
    law_.interrupt();
  }
  /// The reference restarts at the joint's position: the lead restarts, a change of table stays bumpless.
  void reference_jumps() noexcept {
    law_.interrupt();
    if (outgoing_) outgoing_->interrupt();
  }
  /// The integral's torque on a joint at rest.
  double integral_torque_Nm() const noexcept { return law_.integral_torque_Nm(); }

  const TemperatureWeights& temperature_weights() const noexcept { return law_.temperature_weights(); }
  /// Weight alpha_0 of the zero-velocity gain at rest.
  double zero_velocity_weight() const noexcept { return zero_velocity_weight_; }
  /// Torque step of one encoder count, >= 0.
  double count_torque_Nm() const noexcept { return count_torque_Nm_; }

 private:
  double period_s_;
  double encoder_resolution_rad_;
  double velocity_share_;
  ScheduledController law_;
  std::optional<ScheduledController> outgoing_;  ///< law of the previous table, until the next step
  std::optional<double> temperature_C_;          ///< last known
  double count_torque_Nm_ = 0.0;
  double zero_velocity_weight_ = 1.0;
  bool loaded_ = false;
};

}  // namespace strainwave
