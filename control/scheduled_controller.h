// SPDX-License-Identifier: BSD-3-Clause
// Scheduled state feedback with integrator, saturation and anti-windup: the control law of one joint. Real-time safe: nothing here
// allocates or throws.
//
//   e = position - setpoint
//   x = [ integral e, e, velocity - setpoint velocity ]
//
//   law                    l = (alpha_0 F_0 + (1 - alpha_0) sum_i w_i(T) F_i) x
//   feedback               u = l, or with a lead of n periods on a joint with a spring
//                          u = l + n (l - l one period ago)
//   torque                 clamp(u + feed-forward)
//
// Source: Zhao (2006), (3-9)..(3-35), section 5.4. His compensation of friction without a plan is in sim/studies/loop_controllers.h.
//
// Only the slow part of the integral is wanted. With P the Lyapunov matrix of rule 0,
//   V(x) = P_00 slow^2 + (a form in e and velocity error alone)
//   slow = integral + (P_01 e + P_02 velocity error) / P_00
// When the setpoint jumps or the torque saturates, the controller keeps `slow`: the first term of V does not change, and the integral does
// not wind up. V can still rise during saturation: the certificate covers the law within its limits (docs/certificate.md).
//
// The lead compensates dead time: the periods by which a torque acts late (control/table/spring_plant.h). The first sample, and the first
// after a jump of x or F, has no l one period ago: there u = l. Over skipped periods the controller assumes an even change of l.
#pragma once

#include <array>
#include <limits>
#include <optional>

#include "control/table/gain_table.h"

namespace strainwave {

/// One period's input, joint side.
struct ControllerInput {
  double joint_position_rad = 0.0;
  double joint_velocity_rad_s = 0.0;
  double setpoint_position_rad = 0.0;
  double setpoint_velocity_rad_s = 0.0;     ///< 0 for a step reference
  double feedforward_torque_Nm = 0.0;       ///< torque of inertia, friction and load
  std::optional<double> jumped_from_rad{};  ///< previous setpoint, if the setpoint has jumped since
  double torque_limit_Nm = 0.0;             ///< >= 0
  int elapsed_periods = 1;                  ///< since the last sample, >= 1
  /// Torque range that motor and supply allow at this speed.
  double torque_min_Nm = -std::numeric_limits<double>::infinity();
  double torque_max_Nm = std::numeric_limits<double>::infinity();
};

/// One period's result, joint side; torque_Nm = feedback + feedforward, limited.
struct ControllerOutput {
  double torque_Nm = 0.0;
  double feedback_torque_Nm = 0.0;
  double feedforward_torque_Nm = 0.0;
  double zero_velocity_weight = 1.0;  ///< alpha_0
  bool saturated = false;
};

class ScheduledController {
 public:
  ScheduledController() = default;
  /// `gains` and the memberships of `friction` must have passed find_defect(). The controller keeps no reference to them. `lead_periods` >= 0.
  ScheduledController(const FeedbackGains& gains, const FuzzyFriction& friction, const PlantIdentity& plant,
                      double lead_periods = 0.0) noexcept;

  /// Layer 1: recomputes the temperature weights and everything that depends only on them. May be called at a
  /// slower rate than step(). The temperature must be finite; it is clamped to the table's range.
  void set_temperature(double temperature_C) noexcept;

  /// Layer 2 and the control law: one sample.
  ControllerOutput step(const ControllerInput& input) noexcept;

  /// Forgets the integral and the last sample.
  void reset() noexcept;
  /// x jumps, or another torque is applied, before the next sample: the lead restarts.
  void interrupt() noexcept { last_law_Nm_.reset(); }

  /// Bumpless transfer from another controller, whose l was `last_law_Nm` one period ago. Chooses the integral so that step(input) gives
  /// `torque_Nm`, unless it saturates. Without an integrator only the lead continues.
  void carry_over(const ControllerInput& input, double torque_Nm,
                  std::optional<double> last_law_Nm = {}) noexcept;
  /// l one period ago, if known.
  std::optional<double> last_law_Nm() const noexcept { return last_law_Nm_; }

  const TemperatureWeights& temperature_weights() const noexcept { return weights_; }
  double integral_rad_s() const noexcept { return integral_rad_s_; }
  /// The integral's torque on a joint at rest: the load and friction that it has learned.
  double integral_torque_Nm() const noexcept;

 private:
  struct Terms {
    double law_Nm, integral_gain, zero_weight;
  };
  Terms evaluate(const ControllerInput& input) const noexcept;
  void keep_slow_part(const ControllerInput& input) noexcept;
  double fast_part(const ControllerInput& input, double setpoint_position_rad) const noexcept;
  double lead_in(const ControllerInput& input) const noexcept;

  std::array<GainRow, kMaxTemperatureRules> rules_{};  ///< F_i
  FuzzyFriction friction_;
  GainRow zero_velocity_gain_ = GainRow::Zero();  ///< F_0; without scheduling the only gain
  double period_s_ = 0.0;
  double lead_periods_ = 0.0;
  bool scheduled_ = false;
  bool has_integrator_ = false;

  TemperatureWeights weights_;
  GainRow high_velocity_gain_ = GainRow::Zero();  ///< sum_i w_i F_i at the last temperature
  double position_share_s_ = 0.0;                 ///< P_01 / P_00
  double velocity_share_s2_ = 0.0;                ///< P_02 / P_00
  double integral_rad_s_ = 0.0;
  double slow_rad_s_ = 0.0;  ///< slow part of the integral at the last sample
  std::optional<double> last_law_Nm_;
  bool saturated_ = false;  ///< at the last sample
};

}  // namespace strainwave
