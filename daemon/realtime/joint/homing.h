// SPDX-License-Identifier: BSD-3-Clause
// Homing: searches for a place of known position at one low speed, within limits of travel and time. A state
// machine that turns measurements into orders; it moves nothing itself. Real-time safe; time is an argument.
// `d` is the search's direction.
//
//   switch:  d until it closes, then -d until it opens = home; always the same edge
//   index:   d, or after the switch -d, to the next pulse = home
//   stop:    d until the joint stands still for 0.1 s against `stop_torque_Nm` = home; then holds that place
//
// A limit switch other than the one sought reverses a search, or the way to the index, once.
#pragma once

#include <cstdint>

#include "drivers/actuator.h"

namespace strainwave {

enum class HomingTarget {
  kNone,
  kHomeSwitch,
  kLimitSwitch,  ///< in the search's direction
  kIndex,
  kStop  ///< mechanical end stop
};

struct HomingConfig {
  HomingTarget target = HomingTarget::kNone;
  bool required = false;           ///< setpoints are refused until the joint is homed
  bool then_index = false;         ///< home is the first index pulse after the switch
  double direction = -1.0;         ///< of the search: -1 or 1
  double home_position_rad = 0.0;  ///< joint position of the place found
  double speed_rad_s = 0.05;       ///< > 0; a switch is located to this times the period
  double stop_torque_Nm = 0.0;     ///< > 0: a joint that stands still against it is at its mechanical stop
  double travel_rad = 1.0;         ///< > 0: largest distance from the start, to either side
  double timeout_s = 60.0;         ///< > 0
};

class Homing {
 public:
  enum class Phase { kIdle, kSearching, kLeaving, kToIndex, kPushing, kFound, kFailed };

  /// What the joint must do from now on.
  struct Order {
    enum class Kind { kGoOn, kMove, kStop };
    Kind kind = Kind::kGoOn;
    double target_rad = 0.0;  ///< kMove, at the homing speed; never beyond the travel
  };

  /// Measurements of the joint. Positions are as the drive counts them.
  struct Observation {
    double joint_position_rad = 0.0;
    JointInputs inputs;
    std::int64_t now_ns = 0;
    double torque_Nm = 0.0;  ///< from the controller, or from a drive that closes its own loop
  };

  explicit Homing(const HomingConfig& config) noexcept : config_(config) {}

  bool possible() const noexcept { return config_.target != HomingTarget::kNone; }
  /// Begins a search and returns its first order.
  Order begin(const Observation& observation) noexcept;
  /// One period.
  Order step(const Observation& observation) noexcept;
  void abort() noexcept { phase_ = Phase::kIdle; }

  Phase phase() const noexcept { return phase_; }
  /// Position of home, as the drive counts. Valid from kFound on, even while the joint still comes to rest.
  double found_rad() const noexcept { return found_rad_; }

 private:
  bool at_switch(const JointInputs& inputs) const noexcept;
  bool other_limit_ahead(const JointInputs& inputs) const noexcept;
  bool may_go_on(const Observation& observation) const noexcept;
  Order go(Phase phase, double direction) noexcept;
  Order push(const Observation& observation) noexcept;
  Order found(double position_rad) noexcept;
  Order fail() noexcept {
    phase_ = Phase::kFailed;
    return {};
  }

  HomingConfig config_;
  Phase phase_ = Phase::kIdle;
  double heading_ = 0.0;  ///< direction of the present motion
  double begin_rad_ = 0.0;
  double found_rad_ = 0.0;
  std::int64_t begin_ns_ = 0;
  double marked_rad_ =
      0.0;  ///< leaving: where the switch closed; pushing: where the joint stands since marked_ns_
  std::int64_t marked_ns_ = 0;
  bool confirmed_ = false;        ///< leaving: the switch was seen again
  std::int64_t index_count_ = 0;  ///< count when the motion towards the index began
};

}  // namespace strainwave
