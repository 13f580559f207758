// SPDX-License-Identifier: BSD-3-Clause
// Corrects the table's friction by the feedback that acted while the joint moved. Real-time safe. Joint side, SI.
//
//   friction   F(w, T) = sum_i w_i(T) (1 + s_i) F_i(w)          F_i: the Stribeck curve of temperature rule i
//   learning   s_i'    = rate  w_i u sign(w) / (F_i sum_j w_j^2)
//              load'   = load_rate  u                           u: feedback torque, w: planned velocity of the motor
//
// During a motion in one direction both together add (rate + load_rate) u per second to the feed-forward: in the loop, learning multiplies
// the feedback law by (1 + (rate + load_rate) / s). A scale belongs to its temperature rule: friction learned on a cold morning applies
// again on the next one. Source: Friedland and Park (1992), adaptive friction compensation, with the table as the prior.
//
// Learning is fast, so that the end of a motion dominates it: with a wrong inertia, braking is taken for friction and load. After a motion
// the mean of the last half second of learning is therefore kept. Source: Polyak and Juditsky (1992), averaging.
#pragma once

#include <algorithm>

#include "control/friction/fuzzy_friction.h"
#include "control/friction/learned_friction.h"

namespace strainwave {

class FrictionLearning {
 public:
  /// Takes the rules of a table that has passed find_defect(). Learned values stay.
  void load(const FuzzyFriction& table) noexcept;
  /// Sets the joint's temperature, as weights of the rules.
  void weigh(const TemperatureWeights& weights) noexcept;

  /// Friction at the present temperature, with the learned scales.
  const FrictionParameters& friction() const noexcept { return friction_; }
  double load_Nm() const noexcept { return learned_.load_Nm; }
  /// Friction at the present temperature relative to the table's.
  double factor() const noexcept { return friction_factor(learned_, table_, weights_); }

  /// One period of motion: the feedback added `feedback_Nm` at the planned `motor_velocity_rad_s` != 0.
  void learn(double feedback_Nm, double motor_velocity_rad_s, double elapsed_s) noexcept;

  /// Ends a motion: its mean replaces the learned values. Does nothing if nothing was learned since the last call.
  void end_motion() noexcept;

  /// One period in which the feedback applies `feedback_Nm` to a joint at rest off its target.
  void learn_load(double feedback_Nm, double elapsed_s) noexcept;

  const LearnedFriction& learned() const noexcept { return learned_; }
  /// Values are clamped to their bounds.
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
  LearnedFriction mean_;  ///< of the values learned in this motion
  double weight_ = 0.0;   ///< filled share of the mean's memory, in [0, 1); 0: empty
  bool frozen_ = false;
};

}  // namespace strainwave
