// SPDX-License-Identifier: BSD-3-Clause
// A table's law as it is in use. Real-time safe. Joint side, SI.
//
//   temperature       the last that was known; before the first, the middle of the table's range
//   change of table   bumpless transfer: the integral is chosen so that the next torque is what the gains before it would have given
//                       u'(x, integral') = u(x, integral)
//   a count makes     resolution max_i (|F_i1| + |F_i2| share / T) (1 + n)
//   a lead n          the table's, 0 on a rigid joint; it begins anew after interrupt()
#pragma once

#include <optional>

#include "control/scheduled_controller.h"

namespace strainwave {

class LawInUse {
 public:
  /// `period_s` > 0; `encoder_resolution_rad` >= 0; `velocity_share` in (0, 1] as JointReading has it.
  LawInUse(double period_s, double encoder_resolution_rad, double velocity_share = 1.0) noexcept
      : period_s_(period_s),
        encoder_resolution_rad_(encoder_resolution_rad),
        velocity_share_(velocity_share) {}

  /// Takes a table that has passed find_defect().
  void load(const GainTable& table) noexcept;
  bool loaded() const noexcept { return loaded_; }
  /// Nothing is remembered but table and temperature.
  void begin_anew() noexcept;
  /// True: the weights of the temperature rules have changed.
  bool set_temperature(double temperature_C) noexcept;

  /// One period. The first after a change of table goes on from the torque of the one before it.
  ControllerOutput step(const ControllerInput& input) noexcept;
  /// Another torque than the law's is applied: the next of the law's continues none.
  void interrupt() noexcept {
    outgoing_.reset();
    law_.interrupt();
  }
  /// The reference begins anew from where the joint is.
  void reference_jumps() noexcept {
    law_.interrupt();
    if (outgoing_) outgoing_->interrupt();
  }
  /// What the integral holds of a joint at rest.
  double integral_torque_Nm() const noexcept { return law_.integral_torque_Nm(); }

  const TemperatureWeights& temperature_weights() const noexcept { return law_.temperature_weights(); }
  /// alpha_0 at rest.
  double zero_velocity_weight() const noexcept { return zero_velocity_weight_; }
  /// What a count makes, >= 0.
  double count_torque_Nm() const noexcept { return count_torque_Nm_; }

 private:
  double period_s_;
  double encoder_resolution_rad_;
  double velocity_share_;
  ScheduledController law_;
  std::optional<ScheduledController> outgoing_;  ///< of the table before, until the next torque
  std::optional<double> temperature_C_;          ///< the last that was known
  double count_torque_Nm_ = 0.0;
  double zero_velocity_weight_ = 1.0;
  bool loaded_ = false;
};

}  // namespace strainwave
