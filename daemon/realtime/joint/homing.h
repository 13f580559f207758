// SPDX-License-Identifier: BSD-3-Clause
// Homing: finds the place of known position, at one low speed, within a travel and a time. A state
// machine that is given measurements and says where to go; it moves nothing itself. Real-time safe; time is
// an argument. `d` is the search's direction.
//
//   switch:  d until it closes, then -d until it opens = home; the same edge whatever the search met first
//   index:   d, or from the switch on -d, to the next pulse = home
//   stop:    d until the joint stands, against `stop_torque_Nm`, for a tenth of a second = home; then no more than to hold
//            that place
//
// A limit switch that is not looked for turns a search or a way to the index round, once.
#pragma once

#include <cstdint>

#include "drivers/actuator.h"

namespace strainwave {

enum class HomingTarget {
  kNone,
  kHomeSwitch,
  kLimitSwitch,  ///< in the search's direction
  kIndex,
  kStop  ///< a mechanical one
};

struct HomingConfig {
  HomingTarget target = HomingTarget::kNone;
  bool required = false;           ///< setpoints are refused until the joint is homed
  bool then_index = false;         ///< home is the first index pulse after the switch
  double direction = -1.0;         ///< of the search: -1 or 1
  double home_position_rad = 0.0;  ///< what the place found is called
  double speed_rad_s = 0.05;       ///< > 0; a switch is found to this times the period
  double stop_torque_Nm =
      0.0;                  ///< > 0: a joint that stands against this much torque is at its mechanical stop
  double travel_rad = 1.0;  ///< > 0: no farther from where it began, to either side
  double timeout_s = 60.0;  ///< > 0
};

class Homing {
 public:
  enum class Phase { kIdle, kSearching, kLeaving, kToIndex, kPushing, kFound, kFailed };

  /// What the joint is to do from now on.
  struct Order {
    enum class Kind { kGoOn, kMove, kStop };
    Kind kind = Kind::kGoOn;
    double target_rad = 0.0;  ///< kMove, at the homing speed; never beyond the travel
  };

  /// What the joint does now. Positions as the drive counts them.
  struct Observation {
    double joint_position_rad = 0.0;
    JointInputs inputs;
    std::int64_t now_ns = 0;
    double torque_Nm = 0.0;  ///< that the controller gives
  };

  explicit Homing(const HomingConfig& config) noexcept : config_(config) {}

  bool possible() const noexcept { return config_.target != HomingTarget::kNone; }
  /// Begins anew; the order to begin with.
  Order begin(const Observation& observation) noexcept;
  /// One period.
  Order step(const Observation& observation) noexcept;
  void abort() noexcept { phase_ = Phase::kIdle; }

  Phase phase() const noexcept { return phase_; }
  /// Where home is, as the drive counts; from kFound on, while the joint comes to rest.
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
  double heading_ = 0.0;  ///< of the motion now
  double begin_rad_ = 0.0;
  double found_rad_ = 0.0;
  std::int64_t begin_ns_ = 0;
  double marked_rad_ =
      0.0;  ///< leaving: where the switch closed; pushing: since marked_ns_ the joint stands here
  std::int64_t marked_ns_ = 0;
  bool confirmed_ = false;        ///< leaving: the switch was seen again
  std::int64_t index_count_ = 0;  ///< when the motion towards the index began
};

}  // namespace strainwave
