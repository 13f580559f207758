// SPDX-License-Identifier: BSD-3-Clause
// The table's friction, corrected by what the feedback had to add while the joint moved. Real-time safe. Joint side, SI.
//
//   friction   F(w, T) = sum_i w_i(T) (1 + s_i) F_i(w)          F_i: the Stribeck curve of temperature rule i
//   learning   s_i'    = rate  w_i u sign(w) / (F_i sum_j w_j^2)
//              load'   = load_rate  u                           u: feedback torque, w: planned velocity of the motor
//
// Together both add (rate + load_rate) u per second to the feed-forward of a motion in one direction: in the loop, learning multiplies the
// feedback law by (1 + (rate + load_rate) / s). A scale belongs to its temperature rule: what a cold morning has shown is
// there on the next cold morning. Source: Friedland and Park (1992), adaptive friction compensation, with the table as the prior.
//
// Learning is so fast that the end of a motion shows in it more than the motion: with a wrong inertia, braking is taken for friction and load.
// What stays of a motion is therefore the mean of what was learned in its last half second. Source: Polyak and Juditsky (1992), averaging.
#pragma once

#include <algorithm>

#include "control/friction/fuzzy_friction.h"
#include "control/friction/learned_friction.h"

namespace strainwave {

class FrictionLearning {
 public:
  /// Takes the rules of a table that has passed find_defect(). What was learned stays.
  void load(const FuzzyFriction& table) noexcept;
  /// The joint's temperature as weights of the rules.
  void weigh(const TemperatureWeights& weights) noexcept;

  /// Friction at the weighed temperature, scales included.
  const FrictionParameters& friction() const noexcept { return friction_; }
  double load_Nm() const noexcept { return learned_.load_Nm; }
  /// Friction at the weighed temperature over the table's.
  double factor() const noexcept { return friction_factor(learned_, table_, weights_); }

  /// A period of motion in which `feedback_Nm` was added at the planned `motor_velocity_rad_s` != 0.
  void learn(double feedback_Nm, double motor_velocity_rad_s, double elapsed_s) noexcept;

  /// The motion is over: its mean stays. Nothing happens where nothing was learned since the last call.
  void end_motion() noexcept;

  /// A period in which a joint at rest is held off its place by `feedback_Nm`.
  void learn_load(double feedback_Nm, double elapsed_s) noexcept;

  const LearnedFriction& learned() const noexcept { return learned_; }
  /// Values outside of the bounds are brought to them.
  void set(const LearnedFriction& learned) noexcept;
  void set_load(double load_Nm) noexcept {
    learned_.load_Nm = load_Nm;
    weight_ = 0.0;
  }
  /// While frozen nothing is learned.
  void freeze(bool frozen) noexcept { frozen_ = frozen; }
  bool frozen() const noexcept { return frozen_; }

 private:
  void blend() noexcept;
  void add_to_mean(double elapsed_s) noexcept;
  double rule_friction_Nm(std::size_t rule, double stribeck, double speed_rad_s) const noexcept;

  FuzzyFriction table_;
  TemperatureWeights weights_;
  double reciprocal_squares_ = 1.0;  ///< 1 / sum w_j^2
  FrictionParameters friction_;
  LearnedFriction learned_;
  LearnedFriction mean_;  ///< of this motion
  double weight_ = 0.0;   ///< of what mean_ is of, in [0, 1); 0: of nothing
  bool frozen_ = false;
};

}  // namespace strainwave
