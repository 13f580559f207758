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
// The integral has two duties, of which only the slow one is wanted. With P the Lyapunov matrix of rule 0,
//   V(x) = P_00 slow^2 + (a form in e and velocity alone)
//   slow = integral + (P_01 e + P_02 velocity error) / P_00
// A setpoint that jumps and a saturated torque keep `slow`: for a given e and velocity that costs least, and nothing winds up. While the torque is
// limited V can rise: the certificate is of the law within its limits (docs/certificate.md).
//
// A lead makes up for the periods by which a torque acts late (control/table/spring_plant.h). The first sample, and the first after a jump of x or
// F, has no l one period ago: there u = l. Over periods that were left out l has changed evenly.
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
  double feedforward_torque_Nm = 0.0;       ///< what the motion needs: inertia, friction, load
  std::optional<double> jumped_from_rad{};  ///< the setpoint one period ago, where it has jumped since
  double torque_limit_Nm = 0.0;             ///< >= 0
  int elapsed_periods = 1;                  ///< >= 1, since the last sample
  /// What the supply leaves of it at this speed.
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
  /// `gains` and the memberships of `friction` must have passed find_defect(). What the law needs of them is copied. `lead_periods` >= 0.
  ScheduledController(const FeedbackGains& gains, const FuzzyFriction& friction, const PlantIdentity& plant,
                      double lead_periods = 0.0) noexcept;

  /// Layer 1: recomputes the temperature weights and everything that depends only on them. May be called at a
  /// slower rate than step(). The temperature must be finite; it is clamped to the table's range.
  void set_temperature(double temperature_C) noexcept;

  /// Layer 2 and the control law: one sample.
  ControllerOutput step(const ControllerInput& input) noexcept;

  /// Forgets the integral and the last sample.
  void reset() noexcept;
  /// Until the next sample x jumps, or another torque is applied.
  void interrupt() noexcept { last_law_Nm_.reset(); }

  /// Chooses the integral so that step(input) would give `torque_Nm` (unless it saturates): the change-over
  /// from another controller, which had `last_law_Nm` one period ago, makes no torque step. Without an integrator the lead alone goes on.
  void carry_over(const ControllerInput& input, double torque_Nm,
                  std::optional<double> last_law_Nm = {}) noexcept;
  /// l one period ago, if there was one.
  std::optional<double> last_law_Nm() const noexcept { return last_law_Nm_; }

  const TemperatureWeights& temperature_weights() const noexcept { return weights_; }
  double integral_rad_s() const noexcept { return integral_rad_s_; }
  /// The integral's part of the torque of a joint at rest: what it has learnt of load and friction.
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
  GainRow zero_velocity_gain_ = GainRow::Zero();  ///< F_0; of a controller without temperature its only gain
  double period_s_ = 0.0;
  double lead_periods_ = 0.0;
  bool scheduled_ = false;
  bool has_integrator_ = false;

  TemperatureWeights weights_;
  GainRow high_velocity_gain_ = GainRow::Zero();  ///< sum_i w_i F_i at the last temperature
  double position_share_s_ = 0.0;                 ///< P_01 / P_00
  double velocity_share_s2_ = 0.0;                ///< P_02 / P_00
  double integral_rad_s_ = 0.0;
  double slow_rad_s_ = 0.0;  ///< of the last sample
  std::optional<double> last_law_Nm_;
  bool saturated_ = false;  ///< at the last sample
};

}  // namespace strainwave
