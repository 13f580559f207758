// SPDX-License-Identifier: BSD-3-Clause
// Homing: finds the place of known position, at a low speed, within a travel and a time. A state
// machine that is given measurements and says where to go; it moves nothing itself. Real-time safe; time is
// an argument.
//
// A switch is left, always towards the same side and at the creep speed, and the place where it opens is
// home: the same edge whatever the search met first. `d` is the search's direction.
//
//   search:  d until the switch closes -> stop
//   creep:   -d until it opens = home
//   creep:   -d to the next index pulse = home, if that is asked for
//   rest
//
// A limit switch that is not looked for turns the search round, once. What overshot the switch returns to it
// first. The index alone: creep in d to the next pulse.
//
// A mechanical stop is home itself: creep in d until the joint stands, against `stop_torque_Nm`, for a tenth of a second; then
// no more than to hold that place.
#pragma once

#include <cstdint>

#include "drivers/actuator.h"

namespace strainwave {

enum class HomingTarget {
  kNone,
  kHomeSwitch,
  kNegativeLimit,
  kPositiveLimit,
  kIndex,
  kNegativeStop,
  kPositiveStop
};

struct HomingConfig {
  HomingTarget target = HomingTarget::kNone;
  bool required = false;            ///< setpoints are refused until the joint is homed
  bool then_index = false;          ///< home is the first index pulse after the switch
  double direction = -1.0;          ///< of the search: -1 or 1; towards its limit switch whatever this says
  double home_position_rad = 0.0;   ///< what the place found is called
  double search_speed_rad_s = 0.1;  ///< > 0
  double creep_speed_rad_s = 0.01;  ///< > 0
  double stop_torque_Nm =
      0.0;                  ///< > 0: a joint that stands against this much torque is at its mechanical stop
  double travel_rad = 1.0;  ///< > 0: no farther from where it began, to either side
  double timeout_s = 60.0;  ///< > 0
};

class Homing {
 public:
  enum class Phase {
    kIdle,
    kSearching,
    kStopping,
    kReturning,
    kLeaving,
    kToIndex,
    kPushing,
    kResting,
    kDone,
    kFailed
  };

  /// What the joint is to do from now on.
  struct Order {
    enum class Kind { kGoOn, kMove, kStop };
    Kind kind = Kind::kGoOn;
    double target_rad = 0.0;   ///< kMove; never beyond the travel
    double speed_rad_s = 0.0;  ///< kMove
  };

  /// What the joint does now. Positions as the drive counts them.
  struct Observation {
    double joint_position_rad = 0.0;
    JointInputs inputs;
    bool at_rest = false;  ///< the reference has come to its end
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
  /// Where home is, as the drive counts; after kDone.
  double found_rad() const noexcept { return found_rad_; }

 private:
  bool active(const JointInputs& inputs) const noexcept;
  bool other_limit_ahead(const JointInputs& inputs) const noexcept;
  bool may_go_on(const Observation& observation) const noexcept;
  Order go(Phase phase, double direction, double speed_rad_s) noexcept;
  Order halt(Phase phase) noexcept;
  Order fail() noexcept { return halt(Phase::kFailed); }
  Order search(const Observation& observation) noexcept;
  Order after_stop(const Observation& observation) noexcept;
  Order to_index(const Observation& observation) noexcept;
  Order push(const Observation& observation) noexcept;
  Order found(double position_rad) noexcept;

  HomingConfig config_;
  Phase phase_ = Phase::kIdle;
  double search_direction_ = -1.0;  ///< d
  double heading_ = 0.0;            ///< of the motion now
  double begin_rad_ = 0.0;
  double found_rad_ = 0.0;
  std::int64_t begin_ns_ = 0;
  double stands_at_rad_ = 0.0;  ///< while pushing
  std::int64_t stands_since_ns_ = 0;
  std::int64_t index_count_ = 0;  ///< when the motion towards the index began
  bool turned_ = false;
};

}  // namespace strainwave
