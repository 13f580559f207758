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
#include "control/encoder_side.h"
#include "control/friction_side.h"
#include "control/gain_table.h"
#include "control/gains_in_use.h"
#include "control/jerk_limit.h"
#include "control/joint_model.h"
#include "control/landing.h"
#include "control/landing_attempts.h"
#include "control/link_corrections.h"
#include "control/link_model.h"
#include "control/link_motion.h"
#include "control/motor_limits.h"
#include "control/reference_shaper.h"
#include "control/rest_detector.h"
#include "control/scheduled_controller.h"
#include "control/state_estimator.h"
#include "control/stream_target.h"

namespace strainwave {

/// One joint's configuration. Each feature can be switched off;
/// without any, the plain control law of the table is left.
struct JointControllerConfig {
  double period_s = 0.001;                 ///< > 0, the table's
  double encoder_resolution_rad = 0.0;     ///< position of one count at the joint; 0: exact
  double encoder_deviation_counts = 0.02;  ///< how evenly its edges lie, noise included, standard deviation
  /// How evenly positions are sampled, >= 0, standard deviation.
  double sampling_deviation_s = 0.0;
  /// Periods between a torque's computation and its effect, 0..kMaxControlDelay.
  int delay_periods = 0;
  double torque_limit_Nm = 0.0;  ///< > 0; the table's limit applies as well
  MotorLimits motor;
  MotionLimits motion;  ///< of the reference; what the joint can do limits it further
  /// Of the reference, > 0; with use_shaping. Where it is so low that kMaxMeanPeriods do not suffice, accelerations are lower, too.
  /// Without it moves that begin at rest are eased where a spring may hang on the joint that nobody told of: a step of the acceleration
  /// swings it.
  std::optional<double> jerk_limit_rad_s3;
  /// How long a stream whose samples do not come goes on as it was; at least two of its intervals, at most 0.2 s.
  double stream_bridge_s = 0.05;
  /// Share of the torque that the reference leaves to the feedback, in [0, 1).
  double torque_reserve = 0.02;

  bool use_shaping = true;  ///< else targets are steps
  bool use_rest = true;     ///< at the target the torque and the integral stand still
  /// The joint has no spring between motor and load that matters: its encoder shows the one inertia that the
  /// table is for. Only then a reference that the joint has left may begin anew from where the joint is.
  bool rigid = false;
  /// Position, velocity, friction, load and inertia estimated from encoder and torque, over the delay as well, by
  /// the model of one inertia: for joints that are rigid. Else the velocity is the measured one or the difference
  /// of two readings, and load and friction are the integral's.
  bool use_observer = false;
  bool use_landing = false;  ///< the last counts by pushes; only with rigid, use_observer and use_rest
  bool use_monitor = true;   ///< without it only to study what it prevents
  /// Motions that do not swing the link; only with use_shaping, without rigid. The observer knows one inertia and is then not used.
  /// The target is the link's, and both inertias together are the joint's. Its gravity is the one below.
  std::optional<LinkModel> link;
  /// The motor's, whose motion is the model's; or the link's: no model is then followed, and the law is on its reading (link_velocity.h).
  EncoderSide encoder_side = EncoderSide::kMotor;
  /// What gravity makes of link and payload, as far as it is told; only without use_observer, which finds it by itself. Loads
  /// that are known otherwise come on top.
  GravityLoad gravity;
};

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
  /// The reference is not where the stream is: the limits do not let it, or not yet.
  bool off_stream = false;
  MotionPhase phase = MotionPhase::kTracking;
  JointEstimate estimate;  ///< of this sample
  /// That shows, besides gravity and what a stream tells: the observer's, or what the feedback has asked for besides the load that is known.
  double load_Nm = 0.0;
  int replans = 0;  ///< since start(): how often `reference` began anew from where the joint was
  MonitorState monitor = MonitorState::kWatching;
};

/// What is where a stream is at a sample's time: the joint, or the plan, which the joint follows stream_lead_s() later.
enum class OnTime { kJoint, kPlan };

class JointController {
 public:
  /// Not real-time safe: some milliseconds where there is a link.
  explicit JointController(const JointControllerConfig& config) noexcept;

  /// Takes `table`, which must be certified for this joint and period. While running the change makes no
  /// torque step: the integral is chosen so that the torque is what the old gains would have given.
  void load(const GainTable& table) noexcept;
  bool has_table() const noexcept { return has_table_; }

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
  /// With OnTime::kJoint the joint is where a stream is because the controller is so much ahead of it: a sample that comes later than
  /// this before its time is carried forward.
  double stream_lead_s() const noexcept;
  /// Decelerates to rest and holds.
  void stop() noexcept;
  /// Lets go: until what pushes the joint has let go of it or it stands, the torque is what holds `load_Nm`, gravity and what a stream tells
  /// of. Then it decelerates to rest and holds. A load of no more than `let_go_Nm` besides has let go.
  void yield(double load_Nm, double let_go_Nm) noexcept;
  bool yields() const noexcept { return phase_ == MotionPhase::kYielding; }
  /// Where the motion ends, as far as the orders say: of a stream its last sample.
  double target_rad() const noexcept { return streamed_ ? sample_position_rad_ : shaper_.target_rad(); }

  /// What the encoder reads once the joint rests at its target: with a link whose weight winds the spring up, not the target itself.
  double rest_position_rad() const noexcept {
    return linked() ? link_motion_->motor_rest_rad(shaper_.target_rad()) : shaper_.target_rad();
  }

  /// What a joint at rest carries, as far as it is known: gravity as it is told, and the load besides.
  double held_load_Nm() const noexcept;

  /// One period. Needs a table and start(); without a table the torque is 0.
  JointStep step(const JointMeasurement& measurement) noexcept;

  /// Weights of the temperature rules in use.
  const TemperatureWeights& temperature_weights() const noexcept { return primary_.temperature_weights(); }

 private:
  // The steps of a period, in their order.
  void choose_gains(const JointMeasurement& measurement) noexcept;
  void keep_outgoing() noexcept;
  void advance_reference(int elapsed_periods) noexcept;
  bool goes_on_anew(const JointMeasurement& measurement) noexcept;
  void go_on_from_here() noexcept;
  void choose_phase(const JointMeasurement& measurement) noexcept;
  void go_on_yielding(int elapsed_periods) noexcept;
  void weigh(const ControllerOutput& output, int elapsed_periods) noexcept;
  ControllerOutput compute_torque(const JointMeasurement& measurement) noexcept;
  void hand_over(ControllerOutput& output) noexcept;
  double handed_over_Nm(double beyond_Nm) const noexcept;
  void soften(bool soft) noexcept;
  void watch(const ControllerOutput& output, int elapsed_periods) noexcept;

  void limit_reference(ReferenceShaper& shaper) const noexcept;
  void advance_references() noexcept;
  bool plan_rests() const noexcept;
  void begin_plan(double position_rad, double velocity_rad_s) noexcept;
  void ease() noexcept;
  void end_easing() noexcept;
  JointModel loaded_model() const noexcept;
  void forget_told_load(int elapsed_periods) noexcept;
  void limit_speed(double speed_limit_rad_s) noexcept;
  void new_target() noexcept;
  MotionLimits present_limits(double speed_rad_s) const noexcept;
  void advance_link(int elapsed_periods) noexcept;
  void plan_link_motion(double from_rad) noexcept;
  bool correct_link(double reading_rad) noexcept;
  bool torque_is_planned() const noexcept;
  EstimateSource estimate_source() const noexcept;

  ControllerOutput track() noexcept;
  ControllerOutput apply(double torque_Nm) const noexcept;
  double planned_torque_Nm() const noexcept;
  void follow_disturbance(int elapsed_periods) noexcept;
  double planned_friction_Nm() const noexcept;
  void follow_friction(int elapsed_periods) noexcept;
  double planned_velocity_rad_s() const noexcept;
  bool swings_over(double off_rad, double near_rad) noexcept;
  bool reference_moves() const noexcept;
  /// What it follows may flicker about a place.
  bool may_dither() const noexcept { return streamed_ && on_time_ == OnTime::kJoint; }
  double estimated_load_Nm() const noexcept;
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
  ScheduledController& active() noexcept {
    return gains_in_use_ == GainsInUse::kFallback ? fallback_ : primary_;
  }

  /// What yield() began.
  struct Yielding {
    double load_Nm = 0.0;        ///< besides gravity, held ...
    double let_go_Nm = 0.0;      ///< ... until no more shows besides
    double stands_at_rad = 0.0;  ///< about where the joint was last seen to stand
    int periods = 0;             ///< that it has stood, or been let go
  };

  JointControllerConfig config_;
  ReferenceShaper shaper_;
  ReferenceShaper ordered_;              ///< the same orders, never restarted
  std::optional<JerkLimit> easing_;      ///< of moves that begin at rest, where no limit of the jerk is given
  std::optional<JerkLimit> jerk_limit_;  ///< of what shaper_ plans, while it is limited
  std::optional<JerkLimit> ordered_jerk_;  ///< of what ordered_ does
  StreamTarget stream_;
  std::optional<LinkMotion> link_motion_;
  StateEstimator state_;
  Landing landing_;
  LandingAttempts attempts_;
  LinkCorrections corrections_;
  ChatterMonitor monitor_;
  FrictionSide friction_side_;    ///< of a stream
  EasedDisturbance disturbance_;  ///< that the planned torque is made of
  RestDetector rest_detector_;
  ScheduledController primary_;
  ScheduledController fallback_;
  std::optional<ScheduledController>
      outgoing_;      ///< what was active before the gains changed, until the next torque
  JointModel model_;  ///< the table's, at this temperature
  Reference reference_;
  Reference ordered_reference_;
  double setpoint_velocity_rad_s_ = 0.0;  ///< the reference's, as late as the estimate of the joint's
  Reference planned_;        ///< with a link: of a rigid joint, from which the link's motion is made
  MotorPlan motor_plan_;     ///< with a link
  double link_share_ = 1.0;  ///< of the acceleration that a rigid joint could have
  MotionLimits motion_;      ///< the configuration's, and this order's speed
  PositionRange stream_range_;
  double sample_position_rad_ = 0.0;  ///< of the stream's last
  double torque_limit_Nm_ = 0.0;
  std::optional<double> temperature_C_;       ///< the last that was known
  double hold_torque_Nm_ = 0.0;               ///< besides told_load_
  double count_torque_Nm_ = 0.0;              ///< that a count makes by its position
  double difference_torque_Nm_ = 0.0;         ///< and as a velocity from one reading to the next as well
  std::optional<double> fallback_torque_Nm_;  ///< the last torque before the fallback
  ToldLoad told_load_;                        ///< by the stream, and what is left of it since
  double shown_load_Nm_ = 0.0;                ///< JointStep's
  Yielding yielding_;
  double handover_Nm_ = 0.0;           ///< what is left of its difference to the law's
  double reference_rest_s_ = 0.0;      ///< since when it rests, while tracking
  double zero_velocity_weight_ = 1.0;  ///< alpha_0 at rest
  int replans_ = 0;                    ///< since start()
  int plans_ = 0;                      ///< new ones since the target or the phase changed
  int plan_side_ = 0;                  ///< of the target, on which the last of them began; 0: none yet
  int away_periods_ = 0;               ///< that a resting joint has been off its target
  bool stands_ = false;                ///< as it was found by start(): it has left its count for nothing yet
  int side_ = 0;         ///< of the reference, on which the joint was last, beyond the last counts
  double near_s_ = 0.0;  ///< since when it is within those
  bool swung_ = false;   ///< over to the other, in this period
  bool hunted_ = false;  ///< the last counts are left to the integral, in this period
  GainsInUse gains_in_use_ = GainsInUse::kNone;
  MotionPhase phase_ = MotionPhase::kTracking;
  bool turned_back_ = false;  ///< a new plan has begun on the other side than the last, in this period
  bool has_table_ = false;
  bool replan_ = false;    ///< the reference begins anew from where the joint is
  bool streamed_ = false;  ///< the reference follows stream_
  OnTime on_time_ = OnTime::kJoint;
  StreamTarget::Confinement confined_ = 0;
  StreamTarget::Confinement ordered_confined_ = 0;
  bool soft_ = false;  ///< after the fallback, where chatter went on: with softer gains
};

}  // namespace strainwave
