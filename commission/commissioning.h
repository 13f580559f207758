// SPDX-License-Identifier: BSD-3-Clause
// The steps from a joint that is configured and unknown to one that is measured. Those that move it are stepped once a period, as
// Excitation is; between them the drive is disabled, and what was seen is evaluated. Joint side, SI. Not real-time, but for step().
//
//   identity    what start-up of the drive compared
//   direction   slow ramps of torque, both ways, twice, until the joint moves
//   breakaway   the same ramps: torque at which it began to move
//   friction    strokes at steady speeds
//   motion      strokes with a sum of sines: inertias, spring, delay, gravity
//   comparison  of what is configured with what was measured
//
// A step that fails is the last one.
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
  std::string configuration_text;  ///< what is in it
  bool simulated = false;
  std::string identity;         ///< what start-up of the drive found
  std::string direction_key;    ///< where a wrong direction is put right, in words
  ExcitationConfig excitation;  ///< its part is set by the step
  ToldJoint told;
  ConfiguredNumbers configured;
};

class Commissioning {
 public:
  enum class Step { kIdentity, kDirection, kBreakaway, kFriction, kMotion, kComparison, kEnd };

  /// Goes on where `before`, if there is one, ended: its steps that are done are not made again, but for those that move nothing.
  /// Throws InputError where a limit is too small for the motion.
  explicit Commissioning(const CommissioningConfig& config,
                         std::optional<CommissionRecord> before = std::nullopt);

  /// Begins the next step. What it does and within which limits; nothing where none is left, or one has failed.
  std::optional<std::string> begin();
  /// The step moves the joint: it is to be stepped until this is false, with the drive's power.
  bool moves() const { return excitation_ != nullptr && !excitation_->ended(); }
  /// One period. Allocates nothing unless the step ends early.
  ActuatorCommand step(const ActuatorReading& reading);
  /// Brakes and ends the step, and all.
  void abort(const std::string& why);
  /// After the step has ended and the drive is disabled: evaluates it. One line: name, outcome, result.
  std::string finish();

  /// Ends with empty `problem` where all is well.
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
  JointTrace strokes_;  ///< steady ones, then the shaken ones
};

}  // namespace strainwave
