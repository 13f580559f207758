// Everything that one joint needs each period, in one object that the daemon and the simulator both run.
// Real-time safe, load() included: nothing allocates, throws, locks or reads a clock. Only the constructor is not: where the link hangs
// on a spring it solves for a regulator (control/link_model.h). Joint side, SI.
//
//   measurement -> gains in use -> estimate, carried to when the torque will act -> reference -> torque
//
//   tracking   scheduled feedback on the reference + what its motion needs (inertia, friction, load)
//              where the link hangs on a spring: the motor's, so that the link arrives (control/link_motion.h)
//   landing    the last counts, by pushes (control/landing.h)
//   resting    the torque that holds the load, nothing else
//   yielding   likewise, wherever the joint goes, until what pushed it has let go or it stands
//
// What a stream tells of its load is added to the plan, and to the inertia that is reckoned with; what is estimated is the load
// besides. Once the stream is over it is left to the feedback, slowly and only while the feedback works.
//
// Above the certified law stand observer, landing and new plans; a monitor (control/chatter_monitor.h) watches
// them. A joint that chatters falls back to the law alone, without a torque step: velocity from two readings,
// a slower reference, no push that looks for a count, until the next start(). Where that does not end it, the law goes on with a quarter
// of its gains, before the joint must be switched off.
#pragma once

#include <algorithm>
#include <optional>

#include "control/chatter_monitor.h"
#include "control/eased_disturbance.h"
#include "control/eased_torque.h"
#include "control/friction_side.h"
#include "control/gain_table.h"
#include "control/gains_in_use.h"
#include "control/handover.h"
#include "control/joint_controller_config.h"
#include "control/joint_model.h"
#include "control/landing.h"
#include "control/landing_attempts.h"
#include "control/law_in_use.h"
#include "control/link_corrections.h"
#include "control/link_model.h"
#include "control/link_motion.h"
#include "control/new_plans.h"
#include "control/reference_plan.h"
#include "control/rest_detector.h"
#include "control/scheduled_controller.h"
#include "control/state_estimator.h"
#include "control/stream_target.h"
#include "control/swing_side.h"

namespace strainwave {

/// How the torque comes about.
enum class MotionPhase : int { kTracking = 0, kLanding = 1, kResting = 2, kYielding = 3 };

/// One period's result.
struct JointStep {
  ControllerOutput output;
  Reference reference;  ///< what the joint tracks now
  /// What the orders alone make of it: begins with start() and stop() where `reference` does, and is never
  /// begun anew from where the joint is. What the joint is supervised against.
  Reference ordered_reference;
  double joint_velocity_rad_s = 0.0;  ///< measured or estimated, as the feedback used it
  GainsInUse gains_in_use = GainsInUse::kNone;
  bool at_target = false;  ///< the reference has ended on the target
  /// The reference is not where the stream is: the limits do not let it, or not yet. Not while a joint corrects its place at rest.
  bool off_stream = false;
  MotionPhase phase = MotionPhase::kTracking;
  JointEstimate estimate;  ///< of this sample
  /// That shows, besides gravity and what a stream tells: the observer's, or what the feedback has asked for besides the load that is known.
  double load_Nm = 0.0;
  int replans = 0;  ///< since start(): how often `reference` began anew from where the joint was
  MonitorState monitor = MonitorState::kWatching;
};

/// What is where a stream is at a sample's time: the joint, or the plan, which the joint follows plan_lead_s() later.
enum class OnTime { kJoint, kPlan };

class JointController {
 public:
  /// Not real-time safe: some milliseconds where there is a link.
  explicit JointController(const JointControllerConfig& config) noexcept;

  /// Takes `table`, which must be certified for this joint and period. While running the change makes no
  /// torque step: the integral is chosen so that the torque is what the old gains would have given.
  void load(const GainTable& table) noexcept;
  bool has_table() const noexcept { return law_.loaded(); }

  /// Begins with nothing remembered, when the drive becomes enabled: comes to rest from `velocity_rad_s` and
  /// holds, at rest `position_rad`. `holding_torque_Nm` is what held the load until now (a joint that a brake
  /// held: what gravity needs), by default what gravity needs as far as it is told; the first torque at rest continues it.
  void start(double position_rad, double velocity_rad_s = 0.0,
             std::optional<double> holding_torque_Nm = {}) noexcept;
  /// Moves there, from now on; on the way no faster than `speed_limit_rad_s`, if that is above 0.
  void set_target(double position_rad, double speed_limit_rad_s = 0.0) noexcept;
  /// One setpoint of a stream, which it `begins` or goes on with. Speed as above, and inside `range`. Until set_target(), stop(),
  /// start(), or the samples stop coming: then the joint decelerates to rest and holds.
  void follow(const StreamSample& sample, bool begins, double speed_limit_rad_s, const PositionRange& range,
              OnTime on_time = OnTime::kJoint) noexcept;
  /// The samples of the stream that was followed last have stopped coming while it moved, and it has not gone on since.
  bool ran_out_of_samples() const noexcept { return stream_.ended(); }
  /// With OnTime::kJoint the joint is where a stream is because the controller is so much ahead of it: a sample that comes later than
  /// this before its time is carried forward.
  double stream_lead_s() const noexcept;
  /// With OnTime::kPlan, from rest, how much later than the samples say the joint is where they say.
  double plan_lead_s() const noexcept;
  /// The same of the reference: what a mean of the plan, or a link's motion, takes.
  double reference_lag_s() const noexcept;
  /// So many periods, >= 1, after the last step() comes the next, which is told so, too: before samples that have come since are followed.
  /// May be left out where it is one.
  void begin_period(std::int64_t elapsed_periods) noexcept;
  /// Where the plan, which may be ahead of the reference, goes on from in the next period, and how fast.
  double plan_position_rad() const noexcept { return plan_.position_rad(); }
  double plan_velocity_rad_s() const noexcept { return plan_.velocity_rad_s(); }
  /// Decelerates to rest and holds.
  void stop() noexcept;
  /// Lets go: until what pushes the joint has let go of it or it stands, the torque is what holds `load_Nm`, gravity and what a stream tells
  /// of. Then it decelerates to rest and holds. A load of no more than `let_go_Nm`, which is above `load_Nm`, has let go.
  void yield(double load_Nm, double let_go_Nm) noexcept;
  bool yields() const noexcept { return phase_ == MotionPhase::kYielding; }
  /// Where the motion ends, as far as the orders say: of a stream its last sample.
  double target_rad() const noexcept { return streamed() ? sample_position_rad_ : plan_.target_rad(); }

  /// What the encoder reads once the joint rests at its target: with a link whose weight winds the spring up, not the target itself.
  double rest_position_rad() const noexcept {
    return linked() ? link_motion_->motor_rest_rad(plan_.target_rad()) : plan_.target_rad();
  }

  /// What holds a joint at rest, before limits and without a count's flicker: gravity and load as they are told, and the load that shows, in which is
  /// what feedback holds.
  double holding_torque_Nm() const noexcept;

  /// One period. Needs a table and start(); without a table the torque is 0.
  JointStep step(const JointMeasurement& measurement) noexcept;

  /// What the joint is taken for now: the table's at this temperature, with what a stream tells of its load.
  JointModel loaded_model() const noexcept;

  /// Weights of the temperature rules in use.
  const TemperatureWeights& temperature_weights() const noexcept { return law_.temperature_weights(); }

 private:
  // The steps of a period, in their order.
  void choose_gains(const JointMeasurement& measurement) noexcept;
  void advance_reference(int elapsed_periods) noexcept;
  double ahead_of_joint_s() const noexcept;
  double spread_lag_s() const noexcept;
  bool goes_on_anew() noexcept;
  void go_on_from_here() noexcept;
  void choose_phase(const JointMeasurement& measurement) noexcept;
  void go_on_yielding(int elapsed_periods) noexcept;
  void weigh(const ControllerOutput& output, int elapsed_periods) noexcept;
  ControllerOutput compute_torque(const JointMeasurement& measurement) noexcept;
  void ease_answer(ControllerOutput& output, int elapsed_periods) noexcept;
  void hand_over(ControllerOutput& output) noexcept;
  void watch(const ControllerOutput& output, int elapsed_periods) noexcept;

  void limit_reference(ReferencePlan& plan) const noexcept;
  void advance_references() noexcept;
  void ease() noexcept;
  void forget_told_load(int elapsed_periods) noexcept;
  void limit_speed(double speed_limit_rad_s) noexcept;
  void new_target() noexcept;
  MotionLimits present_limits(double speed_rad_s) const noexcept;
  void advance_link(int elapsed_periods) noexcept;
  void plan_link_motion(double from_rad) noexcept;
  bool correct_link(double reading_rad) noexcept;
  bool torque_is_planned() const noexcept;
  EstimateSource estimate_source() const noexcept;

  ControllerOutput track(int elapsed_periods) noexcept;
  ControllerOutput apply(double torque_Nm) const noexcept;
  double planned_torque_Nm(const JointDisturbance& disturbance) const noexcept;
  void follow_disturbance(int elapsed_periods) noexcept;
  double planned_friction_Nm(const JointDisturbance& disturbance) const noexcept;
  void follow_friction(int elapsed_periods) noexcept;
  double planned_velocity_rad_s() const noexcept;
  bool reference_moves() const noexcept;
  /// Where a path turns the reference stands, for some milliseconds.
  bool turns() const noexcept;
  /// What it follows may flicker about a place.
  bool may_dither() const noexcept { return follows_ == Follows::kStreamOnTime; }
  bool streamed() const noexcept { return follows_ != Follows::kTarget; }
  double estimated_load_Nm() const noexcept;
  double held_load_Nm() const noexcept;
  double landing_reach_rad() const noexcept;
  bool landing_possible() const noexcept;
  /// Its pushes are planned for the usual delay.
  bool may_land() const noexcept {
    return config_.use_landing && !fallen_back() && attempts_.allowed() && state_.late_periods() == 0;
  }
  double distance_to_target_rad() const noexcept;
  /// What the reading cannot tell.
  double count_rad() const noexcept { return std::max(config_.encoder_resolution_rad, kExactRestWindow_rad); }
  void enter(MotionPhase phase) noexcept;
  void ask_for_new_plan() noexcept;
  bool fallen_back() const noexcept { return monitor_.state() != MonitorState::kWatching; }
  bool observing() const noexcept { return config_.use_observer && !link_motion_ && !fallen_back(); }
  /// The motor follows what the link's motion asks of it.
  bool linked() const noexcept { return link_motion_ && !fallen_back(); }

  /// What the references follow.
  enum class Follows {
    kTarget,        ///< the last that was ordered, or where a stop ends
    kStreamOnTime,  ///< stream_, with the joint where it is: OnTime::kJoint
    kStreamLater,   ///< stream_, with the plan where it is: OnTime::kPlan
  };
  /// What this period's estimate and reference show of a joint that drives itself.
  struct Signs {
    bool swung_over = false;
    bool turned_back = false;  ///< a new plan has begun on the other side than the last
  };
  /// What yield() began.
  struct Yielding {
    double load_Nm = 0.0;        ///< besides gravity, held ...
    double let_go_Nm = 0.0;      ///< ... until no more shows
    double stands_at_rad = 0.0;  ///< about where the joint was last seen to stand
    int periods = 0;             ///< that it has stood, or been let go
  };

  JointControllerConfig config_;
  ReferencePlan plan_;
  ReferencePlan ordered_;  ///< the same orders, never restarted
  StreamTarget stream_;
  std::optional<LinkMotion> link_motion_;
  StateEstimator state_;
  CurrentLoop current_loop_;
  Landing landing_;
  LandingAttempts attempts_;
  LinkCorrections corrections_;
  NewPlans new_plans_;
  SwingSide swing_side_;
  Signs signs_;
  ChatterMonitor monitor_;
  FrictionSide friction_side_;    ///< of a stream
  EasedDisturbance disturbance_;  ///< that the planned torque is made of
  EasedTorque answer_;  ///< of a rigid joint to its readings: torque besides the plan's by the model
  RestDetector rest_detector_;
  LawInUse law_;
  Handover handover_;  ///< from what there was to the law alone
  JointModel model_;   ///< the table's, at this temperature
  Reference reference_;
  Reference ordered_reference_;
  double setpoint_velocity_rad_s_ = 0.0;  ///< the reference's, as late as the estimate of the joint's
  Reference planned_;        ///< with a link: of a rigid joint, from which the link's motion is made
  MotorPlan motor_plan_;     ///< with a link
  double link_share_ = 1.0;  ///< of the acceleration that a rigid joint could have
  MotionLimits motion_;      ///< the configuration's, and this order's speed
  PositionRange stream_range_;
  StreamTarget::Confinement confined_ = 0;          ///< of plan_
  StreamTarget::Confinement ordered_confined_ = 0;  ///< of ordered_
  double sample_position_rad_ = 0.0;                ///< of the stream's last
  double torque_limit_Nm_ = 0.0;
  double table_limit_Nm_ = 0.0;  ///< the table's alone
  double hold_torque_Nm_ = 0.0;  ///< besides told_load_
  ToldLoad told_load_;           ///< by the stream, and what is left of it since
  double shown_load_Nm_ = 0.0;   ///< JointStep's
  Yielding yielding_;
  double reference_rest_s_ = 0.0;  ///< since when it rests, while tracking
  bool corrects_ = false;          ///< a plan has begun anew since the target came to rest
  int replans_ = 0;                ///< since start()
  int away_periods_ = 0;           ///< that a resting joint has been off its target
  bool stands_ = false;            ///< as it was found by start(): it has left its count for nothing yet
  bool hunted_ = false;            ///< the last counts are left to the integral, in this period
  MotionPhase phase_ = MotionPhase::kTracking;
  Follows follows_ = Follows::kTarget;
};

}  // namespace strainwave
