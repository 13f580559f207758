// SPDX-License-Identifier: BSD-3-Clause
// Everything that one joint needs each period, in one object that the daemon and the simulator both run.
// Real-time safe, load() included: nothing allocates, throws, locks or reads a clock. Only the constructor is not: it solves for a
// regulator (control/joint/link_model.h). Joint side, SI.
//
//   plan         thm*, wm*, T* of the motor, by trajectory and gear                      (control/joint_plan.h)
//   friction     F(wm*, T) = sum_i w_i(T) (1 + s_i) F_i(wm*)                             (control/friction/friction_learning.h)
//   law          u = k(T, w) [ integral e, e, e' ],   e = reading - plan                 (control/scheduled_controller.h)
//   torque       T* + F + load + u, limited
//   learning     s_i and load from u, while the plan moves and the torque is not limited
//   rest         within a count of its place: the torque that holds; else a small motion (control/rest_corrections.h)
//
// A drive that closes its own loop is ordered the plan, and torque as far as it is known without the law:
//
//   order        thm* at the end of the period in which it acts, T* + F + load, and      (control/joint/drive_mode.h)
//                wm* so much before its middle as the drive's velocity is old
//   velocity     wm* + r (plan - reading), where the drive closes no loop of position
//   learning     s_i and load from the torque that the drive adds by itself, where it says which
//
// A joint that oscillates shows it by its torque (control/oscillation_detector.h).
#pragma once

#include <optional>

#include "control/friction/friction_learning.h"
#include "control/joint/joint_measurement.h"
#include "control/joint/joint_model.h"
#include "control/joint_controller_config.h"
#include "control/joint_plan.h"
#include "control/law_in_use.h"
#include "control/oscillation_detector.h"
#include "control/table/gain_table.h"

namespace strainwave {

/// How the torque comes about.
enum class MotionPhase : int {
  kTracking = 0,  ///< the law on the plan
  kResting = 2,   ///< what holds the joint, constant
  kYielding = 3,  ///< a constant torque while the joint is pushed away, until it stands
};

/// One period's result.
struct JointStep {
  ControllerOutput output;
  MotorOrder order;     ///< of a drive that closes its own loop
  Reference reference;  ///< where the encoder should be read now
  /// The same by the orders alone: while a joint corrects its place at rest, that place. What the joint is supervised against.
  Reference ordered_reference;
  double joint_velocity_rad_s = 0.0;  ///< measured, as the feedback used it
  bool at_target = false;             ///< the motion has ended on the target
  bool off_stream = false;  ///< the limits do not let the reference be where the stream is, or not yet
  MotionPhase phase = MotionPhase::kTracking;
  /// Besides gravity and the stream's load: the learned load and the feedback, the mean over 10 ms.
  double load_Nm = 0.0;
  int corrections = 0;  ///< small motions at rest since the last order
  bool learns = false;  ///< friction and load, in this period
  bool oscillates = false;
};

class JointController {
 public:
  /// Not real-time safe: some milliseconds where there is a link.
  explicit JointController(const JointControllerConfig& config) noexcept;

  /// Takes `table`, which must be certified for this joint and period. While running the change makes no
  /// torque step: the integral is chosen so that the torque is what the old gains would have given.
  void load(const GainTable& table) noexcept;

  /// Begins when the drive becomes enabled: comes to rest from `velocity_rad_s` and holds, at rest `position_rad`.
  /// `holding_torque_Nm` is what held the load until now (of a joint that a brake held: what gravity needs), by default what gravity needs
  /// and what was learned; the first torque at rest continues it. What was learned of friction stays.
  void start(double position_rad, double velocity_rad_s = 0.0,
             std::optional<double> holding_torque_Nm = {}) noexcept;
  /// Moves there, from now on; on the way no faster than `speed_limit_rad_s`, if that is above 0.
  void set_target(double position_rad, double speed_limit_rad_s = 0.0) noexcept {
    plan_.set_target(position_rad, speed_limit_rad_s);
  }
  /// One setpoint of a stream, which it `begins` or goes on with. Speed as above, and inside `range`. Until set_target(), stop(),
  /// start(), or the samples stop coming: then the joint decelerates to rest and holds.
  SampleFate follow(const StreamSample& sample, bool begins, double speed_limit_rad_s,
                    const PositionRange& range) noexcept {
    return plan_.follow(sample, begins, speed_limit_rad_s, range);
  }
  /// A path leads here in so many periods, > 0. The joint is later than this by plan().lead_s().
  void follow_path(double position_rad, double velocity_rad_s, std::int64_t in_periods,
                   const PositionRange& range) noexcept {
    plan_.follow_path(position_rad, velocity_rad_s, in_periods, range);
  }
  /// Decelerates to rest and holds.
  void stop() noexcept { plan_.stop(); }
  /// Lets go: until it stands, the torque is what holds `load_Nm`, gravity and what a stream says. Then it decelerates to rest and holds.
  void yield(double load_Nm) noexcept;
  bool yields() const noexcept { return phase_ == MotionPhase::kYielding; }

  /// So many periods, >= 1, after the last step() comes the next, which is given the same number: before samples that have come since are
  /// followed. Motions speed up with `driving_share` of the torque limit, 0 to 1; what brakes and holds has all of it. May be left out where
  /// both are one.
  void begin_period(std::int64_t elapsed_periods, double driving_share) noexcept {
    plan_.begin_period(elapsed_periods);
    driving_share_ = driving_share;
  }
  /// One period. Needs a table and start(); without a table the torque is 0.
  JointStep step(const JointMeasurement& measurement) noexcept;

  /// Trajectory, plan and place.
  const JointPlan& plan() const noexcept { return plan_; }
  /// What holds a joint at rest, before limits.
  double holding_torque_Nm() const noexcept;
  /// The joint at this temperature, with what was learned and what a stream says of its load.
  PlannedJoint joint() const noexcept;
  /// What was learned. It may be set and frozen at rest or at start-up, without a torque step.
  FrictionLearning& friction() noexcept { return friction_; }
  const FrictionLearning& friction() const noexcept { return friction_; }
  const OscillationDetector& oscillation() const noexcept { return oscillation_; }
  /// Weights of the temperature rules in use.
  const TemperatureWeights& temperature_weights() const noexcept { return law_.temperature_weights(); }

 private:
  // The steps of a period, in their order.
  void advance_plan(const JointMeasurement& measurement) noexcept;
  void choose_phase() noexcept;
  void hold_again() noexcept;
  ControllerOutput compute_torque(const JointMeasurement& measurement) noexcept;
  ControllerOutput track(int elapsed_periods) noexcept;
  bool learn(const JointMeasurement& measurement, const ControllerOutput& output) noexcept;
  void weigh(const ControllerOutput& output, int elapsed_periods) noexcept;
  JointStep result(const ControllerOutput& output, bool learns) const noexcept;

  /// What yield() began.
  struct Yielding {
    double load_Nm = 0.0;        ///< besides gravity, held
    double stands_at_rad = 0.0;  ///< about where the joint was last seen to stand
    int periods = 0;             ///< that it has stood
    void see(double position_rad, double count_rad, int elapsed_periods) noexcept;
  };

  JointControllerConfig config_;
  JointPlan plan_;
  LawInUse law_;
  FrictionLearning friction_;
  JointReading reading_;
  OscillationDetector oscillation_;
  JointModel model_;  ///< inertia, and the shape of friction
  double torque_limit_Nm_ = 0.0;
  double driving_share_ = 1.0;
  double hold_torque_Nm_ = 0.0;
  double shown_load_Nm_ = 0.0;
  MotionPhase phase_ = MotionPhase::kTracking;
  Yielding yielding_;
};

}  // namespace strainwave
