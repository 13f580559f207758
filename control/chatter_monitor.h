// Watches for ever whether a joint chatters or oscillates, whatever the reason: an inertia, a delay, a spring
// or an encoder that the table and the configuration do not know. Real-time safe, O(1) a period.
//
// What counts is a reversal: the torque beyond what the planned motion needs changes its sign, from more than
// a threshold on one side to more than it on the other. Planned motion, however hard, makes none. Thresholds are
// shares of static friction (chatter_monitor.cc): a strong reversal is more than the law's own friction compensation
// makes, and counts always; a weak one could just move the joint, and counts once the reference has come to
// rest for a while; where it has rested for long, in a level of its own, since a sound joint then makes none; and half a second after the reference has come to
// rest what hums about the torque's own mean, weaker than that, too: a joint that gives way before it slides can. Where the plan needs all
// of the torque nothing beyond it can be commanded: there the reversals of the whole torque count, less those that the plan orders: to the same side, beyond half of the threshold. Each
// fills a level that leaks:
//
//   level' = level exp(-period / leak) + reversals
//
//   Watching ----- too many -------------------------> FallenBack   the plain certified law takes over
//   FallenBack --- reversals go on for long enough --> FaultDue     the joint must be switched off
//
// Halfway to the fault, and at once where the joint was to rest and needs no stiffness, the plain law's gains are in doubt, too.
//
// A joint that follows a model of its spring is fed back what it differs from that. Where this asks for half of the torque limit, in the
// mean over some 50 ms, the joint is not the model's: it falls back as well.
//
// A stream that swings the joint to and fro swings what it carries, too, and the law answers that. So strong reversals, and those of the whole
// torque, count from beyond half of what the stream's own torque has swung lately: what its orders explain.
//
// A joint that swings about its place while friction is compensated towards it, long after the reference has come to rest, is driven by that: more
// is compensated than it has. Its swings count in a level of their own, and three sides on end are enough.
//
// A joint that swings past its target and is planned back to it, time and again, reverses as it is planned to. Each new plan from the other side
// counts as a strong reversal: a sound joint makes none.
//
// Single pushes of a landing reverse by design: one counts only when the encoder has contradicted the model
// since the one before, and then a third.
#pragma once

namespace strainwave {

enum class MonitorState : int { kWatching = 0, kFallenBack = 1, kFaultDue = 2 };

/// One period, joint side.
struct ChatterSample {
  double torque_Nm = 0.0;           ///< commanded
  double planned_torque_Nm = 0.0;   ///< what the planned motion and the load need of it; beyond it is excess
  double static_friction_Nm = 0.0;  ///< of the table, at this temperature
  double doubt_Nm = 0.0;  ///< added to every threshold where the plan rests on a spring and a load as told
  double ordered_torque_Nm =
      0.0;  ///< what a stream orders of inertia and told load: its swings are those of a spring, too, that nobody told of
  double feedback_step_Nm = 0.0;  ///< what the least change that the encoder can show makes of the torque
  double torque_limit_Nm =
      0.0;  ///< > 0: beyond a quarter of it on either side nothing is noise, whatever the encoder shows
  /// The law compensates friction by itself now, towards the target from either side.
  bool compensates_friction = true;
  /// A model of motor, spring and link is followed.
  bool follows_model = false;
  /// Torque that the feedback asks for, where a model is followed: as large as the model is wrong. Else 0.
  double innovation_Nm = 0.0;
  bool reference_rests = false;
  /// The joint has come over to the other side of where it is to rest, by more than a push for the last counts leaves.
  bool swung_over = false;
  /// A new plan from where the joint is has begun on the other side of the target than the last one.
  bool turned_back = false;
  bool landing = false;
  bool surprised = false;  ///< the encoder's reading contradicted the model
  int elapsed_periods = 1;
};

class ChatterMonitor {
 public:
  /// `period_s` > 0.
  explicit ChatterMonitor(double period_s) noexcept;

  void reset() noexcept;
  MonitorState step(const ChatterSample& sample) noexcept;
  MonitorState state() const noexcept { return state_; }
  /// Mean of the innovation over some 50 ms, as a share of the torque limit: how far the model that is followed is in doubt.
  double distrust() const noexcept { return distrust_; }
  /// Why it fell back: friction that is compensated at rest drives the joint, for it is more than the joint has.
  bool drives_itself() const noexcept { return drives_itself_; }
  /// After the fallback: chatter has gone on for half of the time that it may, or began where the reference rests.
  bool goes_on() const noexcept { return goes_on_; }

 private:
  /// The side on which a torque last was, beyond a threshold.
  struct Side {
    int sign = 0;  ///< -1, 1; 0: not yet
    bool reversed(double torque_Nm, double threshold_Nm) noexcept;
  };
  void count(const ChatterSample& sample) noexcept;
  void doubt_the_gains() noexcept;
  void follow_orders(const ChatterSample& sample) noexcept;
  /// `share` of its limit.
  bool any_level_reaches(double share) const noexcept;

  double period_s_;
  double leak_;            ///< of the level over a period
  double rest_leak_;       ///< of the level at rest
  double shaken_leak_;     ///< of the level of what moves a joint that is to rest
  double unsettled_leak_;  ///< of the level at a long rest
  double forget_;          ///< of the distrust and the mean torque over a period
  double level_ = 0.0;
  double turned_level_ = 0.0;  ///< reversals of the whole torque, less the plan's
  double rest_level_ = 0.0;
  double shaken_level_ = 0.0;
  double unsettled_level_ = 0.0;
  double hum_level_ = 0.0;
  double mean_torque_Nm_ = 0.0;  ///< over some swings
  double swing_level_ = 0.0;
  double ordered_low_Nm_ = 0.0;  ///< between these the orders have swung lately
  double ordered_high_Nm_ = 0.0;
  double distrust_ = 0.0;
  double chatter_s_ = 0.0;  ///< since the fallback
  double rest_s_ = 0.0;     ///< since when the reference rests
  Side strong_;
  Side torque_;  ///< of the whole torque
  Side plan_;    ///< of what the plan needs of it
  Side weak_;
  Side shaken_;
  Side hum_;
  bool goes_on_ = false;
  bool drives_itself_ = false;
  bool unordered_ = false;          ///< the whole torque has reversed, and the plan not yet to that side
  bool ordered_ = false;            ///< the plan has reversed, and the whole torque not yet to that side
  bool surprised_ = false;          ///< since the last strong reversal
  bool surprised_at_rest_ = false;  ///< since the last weak one
  MonitorState state_ = MonitorState::kWatching;
};

}  // namespace strainwave
