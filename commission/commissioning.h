// SPDX-License-Identifier: BSD-3-Clause
// Measures a configured joint in steps. A step that moves the joint runs once a period, as Excitation does. Between steps the drive is
// disabled, and the trace is evaluated. Joint side, SI. Not real-time, except step().
//
//   identity    the comparisons at the start-up of the drive
//   direction   slow torque ramps until the joint moves, twice each way
//   breakaway   the torque at which it began to move in these ramps
//   friction    strokes at steady speeds
//   motion      strokes with a sum of sines: inertias, spring, delay, gravity
//   comparison  configured against measured values
//
// The first step that fails ends the commissioning.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "commission/commission_record.h"
#include "commission/comparison.h"
#include "commission/excitation.h"
#include "commission/identification.h"

namespace strainwave {

struct CommissioningConfig {
  std::string joint;
  std::string configuration;       ///< path of the file
  std::string configuration_text;  ///< contents of the file
  bool simulated = false;
  std::string identity;         ///< result of the comparisons at start-up
  std::string direction_key;    ///< what corrects a wrong direction, in words
  ExcitationConfig excitation;  ///< each step sets its part
  ToldJoint told;
  ConfiguredNumbers configured;
};

class Commissioning {
 public:
  enum class Step { kIdentity, kDirection, kBreakaway, kFriction, kMotion, kComparison, kEnd };

  /// Continues `before` if it has the same joint and configuration. Completed steps are not repeated, except those without motion, and
  /// ramps before other motion. Throws InputError if a limit is too small for the motion.
  explicit Commissioning(const CommissioningConfig& config,
                         std::optional<CommissionRecord> before = std::nullopt);

  /// Begins the next step. Returns its description with the limits; nothing if no step is left or one has failed.
  std::optional<std::string> begin();
  /// True while the step moves the joint. The caller then enables the drive and calls step() once a period.
  bool moves() const { return excitation_ != nullptr && !excitation_->ended(); }
  /// One period. Allocates nothing unless the step ends early.
  ActuatorCommand step(const ActuatorReading& reading);
  /// Brakes, and ends the step and the commissioning.
  void abort(const std::string& why);
  /// Evaluates a step that has ended, with the drive disabled. Returns one line: name, outcome, result.
  std::string finish();

  /// Its `problem` is empty while all is well.
  const CommissionRecord& record() const { return record_; }

 private:
  bool done(const std::string& name) const;
  std::string announcement() const;
  std::string evaluate();
  std::string find_which_way();
  std::string find_torque_of_breaking_away();
  std::string find_friction_over_speed();
  std::string find_motion();
  std::string compare();

  CommissioningConfig config_;
  CommissionRecord record_;
  Step step_ = Step::kIdentity;
  bool begun_ = false;
  bool resumed_ = false;  ///< the present step was done before
  std::unique_ptr<Excitation> excitation_;
  JointTrace ramps_;
  JointTrace strokes_;  ///< steady strokes, then shaken ones
};

}  // namespace strainwave
