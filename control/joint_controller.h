// SPDX-License-Identifier: BSD-3-Clause
// The controller of one joint. The daemon and the simulator run the same object each period.
// Real-time safe, load() included: nothing allocates, throws, locks or reads a clock. Only the constructor is not: it solves for a
// regulator (control/joint/link_model.h). Joint side, SI.
//
//   plan         thm*, wm*, T* of the motor, by trajectory and gear                      (control/joint_plan.h)
//   friction     F(wm*, T) = sum_i w_i(T) (1 + s_i) F_i(wm*)                             (control/friction/friction_learning.h)
//   law          u = k(T, w) [ integral e, e, e' ],   e = reading - plan                 (control/scheduled_controller.h)
//   torque       T* + F + load + u, limited
//   learning     s_i and load from u while the plan moves, load alone at rest; not while the torque is limited
//   rest         within a count of the target a constant holding torque; otherwise a small motion (control/rest_corrections.h)
//
// A drive that closes its own loop receives the plan, and the known part of the torque, without the law:
//
//   order        thm* at the end of the period in which it acts, T* + F + load, and      (control/joint/drive_mode.h)
//                wm* earlier than the middle of that period by the age of the drive's velocity
//   velocity     wm* + r (plan - reading), where the drive closes no position loop
//   learning     s_i and load from the torque that the drive adds, if the drive reports its torque
//
// The oscillation detector watches the torque (control/oscillation_detector.h).
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

/// How the controller forms the torque.
enum class MotionPhase : int {
  kTracking = 0,  ///< the law follows the plan
  kResting = 2,   ///< a constant holding torque
  kYielding = 3,  ///< holds the load alone while the joint is pushed away, until it stands still
};

/// One period's result.
struct JointStep {
  ControllerOutput output;
  MotorOrder order;     ///< for a drive that closes its own loop
  Reference reference;  ///< expected reading of the encoder now
  /// The reference that the orders alone give, for supervision: during a correction at rest, the ordered place.
  Reference ordered_reference;
  double joint_velocity_rad_s = 0.0;  ///< measured, as the feedback used it
  bool at_target = false;             ///< the motion has ended on the target
  bool off_stream = false;  ///< the limits keep the reference off the stream, or it is still approaching
  MotionPhase phase = MotionPhase::kTracking;
  /// Learned load and feedback torque, without gravity and the stream's load; mean over 10 ms.
  double load_Nm = 0.0;
  int corrections = 0;  ///< small motions at rest since the last order
  bool learns = false;  ///< friction or load, in this period
  bool oscillates = false;
};

class JointController {
 public:
  /// Not real-time safe: takes some milliseconds where there is a link.
  explicit JointController(const JointControllerConfig& config) noexcept;

  /// Takes `table`, which must be certified for this joint and period. A change while running is a bumpless transfer:
  /// the new integral gives the torque that the old gains would have given.
  void load(const GainTable& table) noexcept;

  /// Starts when the drive becomes enabled: decelerates from `velocity_rad_s` to rest and holds; at rest holds `position_rad`.
  /// `holding_torque_Nm` is the torque that held the load until now; where a brake held it, that of gravity. Default: gravity and
  /// the learned load. The first torque at rest continues it. Learned friction stays.
  void start(double position_rad, double velocity_rad_s = 0.0,
             std::optional<double> holding_torque_Nm = {}) noexcept;
  /// Moves to `position_rad` from now on, no faster than `speed_limit_rad_s` if that is above 0.
  void set_target(double position_rad, double speed_limit_rad_s = 0.0) noexcept {
    plan_.set_target(position_rad, speed_limit_rad_s);
  }
  /// Takes one setpoint of a stream; `begins`: the first one. Speed limit as above; the reference stays inside `range`. The stream lasts until
  /// set_target(), stop() or start(), or until samples are missing: then the joint decelerates to rest and holds.
  SampleFate follow(const StreamSample& sample, bool begins, double speed_limit_rad_s,
                    const PositionRange& range) noexcept {
    return plan_.follow(sample, begins, speed_limit_rad_s, range);
  }
  /// A path reaches this point in `in_periods` > 0. The joint reaches it later by plan().lead_s().
  void follow_path(double position_rad, double velocity_rad_s, std::int64_t in_periods,
                   const PositionRange& range) noexcept {
    plan_.follow_path(position_rad, velocity_rad_s, in_periods, range);
  }
  /// Decelerates to rest and holds.
  void stop() noexcept { plan_.stop(); }
  /// Yields to a push: the torque only holds `load_Nm`, gravity and the stream's load, until the joint stands still. Then it is held.
  void yield(double load_Nm) noexcept;
  bool yields() const noexcept { return phase_ == MotionPhase::kYielding; }

  /// The next step() comes `elapsed_periods` >= 1 after the last one, and is given the same number. Call this before follow() of samples that
  /// have arrived since. Motions speed up with `driving_share`, 0 to 1, of the torque limit; braking and holding may use all of it. The call
  /// may be left out where both are 1.
  void begin_period(std::int64_t elapsed_periods, double driving_share) noexcept {
    plan_.begin_period(elapsed_periods);
    driving_share_ = driving_share;
  }
  /// One period. Needs a table and start(); without a table the torque is 0.
  JointStep step(const JointMeasurement& measurement) noexcept;

  /// Trajectory, motor plan and corrections.
  const JointPlan& plan() const noexcept { return plan_; }
  /// Torque that holds the joint at rest, before limits.
  double holding_torque_Nm() const noexcept;
  /// The joint at this temperature, with learned friction and load, and with the stream's load.
  PlannedJoint joint() const noexcept;
  /// Learned friction and load. Setting or freezing them at rest or at start-up makes no torque step.
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

  /// State since yield().
  struct Yielding {
    double load_Nm = 0.0;        ///< held load without gravity
    double stands_at_rad = 0.0;  ///< position around which standstill is counted
    int periods = 0;             ///< at standstill
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
