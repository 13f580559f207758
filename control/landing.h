// Landing: the last counts of a motion, and rest. Over a period or two the known torque moves the joint far
// more exactly than feedback on counts could: one period's push and one period's braking end where they are
// meant to. Real-time safe.
//
// Within a count the encoder is silent, but its edges are not. Three kinds of push, each only while it is needed:
//   slides   across the edge nearest to the target, as slow as friction is known:
//            when the edge comes tells friction
//   probes   onto the edge, as it is believed to lie:
//            the count tells on which side it really is, which halves the doubt
//   the last push, from there to the target
// Then the joint rests: the torque is what holds the load, constant, and nothing hunts.
//
// With more than one torque under way a push is over before the encoder tells of it. Then each is planned to its end by the model and
// not answered on the way, nothing is looked for, and the joint rests within a count.
#pragma once

#include "control/joint_model.h"
#include "control/velocity_observer.h"

namespace strainwave {

/// Torque for the coming period so that a joint at `velocity_rad_s` ends at rest `distance_rad` ahead as soon
/// as it can: push or slow down to a speed from which friction alone, or braking in half a period, stops it
/// there. Not limited.
/// With `samples` > 1 the push lasts that many periods, this one included.
double landing_torque_Nm(const JointModel& model, const JointDisturbance& disturbance, double velocity_rad_s,
                         double distance_rad, double period_s, int samples = 1) noexcept;

struct LandingConfig {
  double period_s = 0.001;              ///< > 0
  double encoder_resolution_rad = 0.0;  ///< 0: exact, nothing to find out
  int delay_periods = 0;                ///< periods between a torque's computation and its effect
};

class Landing {
 public:
  explicit Landing(const LandingConfig& config) noexcept : config_(config) {}

  /// A landing on `target_rad` begins.
  void begin(double target_rad) noexcept;
  /// Torque for the period that begins when `then` is reached;
  /// `now` is the present estimate, `reading_rad` the encoder's.
  double step(const JointEstimate& now, const JointEstimate& then, double reading_rad,
              const JointModel& model) noexcept;
  /// Landed: the torque only holds the load.
  bool resting() const noexcept { return resting_; }

 private:
  enum class Push { kNone, kUnderWay, kOver };
  bool told_late() const noexcept { return config_.delay_periods > 1; }
  double push_as_planned(const JointModel& model) noexcept;
  double tolerance_rad(const JointEstimate& then) const noexcept;
  void choose_push(const JointEstimate& then, double reading_rad, const JointModel& model) noexcept;

  LandingConfig config_;
  double target_rad_ = 0.0;
  double aim_rad_ = 0.0;
  JointEstimate plan_;  ///< where a push that is not answered has brought the joint, by the model
  Push push_ = Push::kNone;
  int still_samples_ = 0;
  int push_samples_ = 0;
  int slides_ = 0;
  int probes_ = 0;
  bool resting_ = false;
};

}  // namespace strainwave
