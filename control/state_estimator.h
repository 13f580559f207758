// Where the joint is at this sample, and where it will be when this period's torque begins to act.
// Real-time safe. Joint side, SI.
//
//   now    the encoder's reading and what the observer, or the difference of two readings, makes of it
//   then   now, carried over the torques that are under way
//
// Over periods that the loop left out the last torque stayed applied: by the clock the newest, as late as it is; with a drive that samples and
// takes torques only when it is told to, the one that acted before, and those that were under way act one by one afterwards.
#pragma once

#include <array>

#include "control/current_loop.h"
#include "control/joint_model.h"
#include "control/velocity_observer.h"

namespace strainwave {

inline constexpr int kMaxControlDelay = 8;
/// What the joint did over a longer stall, no model knows: the estimate begins anew with the two readings around it. By default a longer
/// one is a fault of the loop at 1 kHz.
inline constexpr int kMaxElapsedPeriods = 20;

/// One period's measurements.
struct JointMeasurement {
  double joint_position_rad = 0.0;
  double joint_velocity_rad_s = 0.0;  ///< used only when has_velocity
  double temperature_C = 0.0;         ///< used only when temperature_valid
  /// Else the position is not a reading but where the joint must be by now: nothing to learn from.
  bool has_position = true;
  bool has_velocity = false;
  bool temperature_valid = false;
  /// Periods since the last step(), >= 1; more when the loop left some out. Over those the last torque stayed
  /// applied and the reference went on. After more than kMaxElapsedPeriods both begin anew from where the joint is.
  int elapsed_periods = 1;
  /// >= 0: the position was sampled so many periods before delay_periods has it. More than kMaxControlDelay in all count as
  /// that many, and the observer learns nothing from it.
  int late_periods = 0;
};

/// What position, velocity and load are taken from.
enum class EstimateSource {
  kReadings,  ///< velocity measured, or the difference of two readings; the load is the last that was known
  /// The same of a joint that should stand: a reading that goes to and fro by a count on either side has no velocity. What the law made of it would
  /// drive the joint across the counts' edges for ever, where friction gives way like a spring or the delay is longer than told.
  kReadingsAtRest,
  kObserver,  ///< all of it from encoder and torque, by the model of one inertia
};

struct StateEstimatorConfig {
  VelocityObserverConfig observer;
  int delay_periods = 0;  ///< between a torque's computation and its effect, 0..kMaxControlDelay
  /// Of each difference of two readings in the velocity, without observer (control/link_velocity.h), in (0, 1]. Below 1 a velocity that
  /// the drive measures is not used.
  double velocity_share = 1.0;
  double current_loop_s = 0.0;  ///< >= 0, time constant of the drive's current loop
};

class StateEstimator {
 public:
  explicit StateEstimator(const StateEstimatorConfig& config) noexcept;

  /// Nothing remembered: where the encoder reads `position_rad`, at `velocity_rad_s`, while `load_Nm` was held by a torque as
  /// large. Friction is unknown in units of `friction_scale_Nm`. The next step() is the first.
  void reset(double position_rad, double velocity_rad_s, double load_Nm, double friction_scale_Nm) noexcept;
  /// The position of reset() was this period's reading: by the next one a period will have passed.
  void has_been_read() noexcept { first_ = false; }
  /// One period of a joint like `model`.
  void step(const JointMeasurement& measurement, const JointModel& model, EstimateSource source,
            SurpriseCause cause = SurpriseCause::kLoad) noexcept;
  /// The torque of this period, as far as the motor can deliver it.
  void remember(double torque_Nm) noexcept;

  const JointEstimate& now() const noexcept { return now_; }
  const JointEstimate& then() const noexcept { return then_; }
  /// What acts then, behind the current loop, when this period's torque begins to act; only with EstimateSource::kObserver.
  double acting_then_Nm() const noexcept { return acting_then_Nm_; }
  /// The model with the inertia that shows.
  const JointModel& model() const noexcept { return adapted_; }
  /// By how many periods the newest position is late, as far as they count.
  int late_periods() const noexcept { return late_periods_; }
  double velocity_share() const noexcept { return config_.velocity_share; }
  /// Since the encoder's reading changed, or count_still_anew().
  int still_periods() const noexcept { return still_periods_; }
  void count_still_anew() noexcept { still_periods_ = 0; }

 private:
  int waiting_torques(const JointMeasurement& measurement) const noexcept;
  void prolong(int waiting) noexcept;
  void let_torque_act(int periods, int late_periods, int waiting, const JointModel& model,
                      EstimateSource source, SurpriseCause cause) noexcept;
  void observe(const JointMeasurement& measurement, SurpriseCause cause) noexcept;
  void read(const JointMeasurement& measurement, EstimateSource source) noexcept;
  void follow_reading(double position_rad) noexcept;
  void begin_anew(const JointMeasurement& measurement, const JointModel& model) noexcept;
  double elapsed_s(const JointMeasurement& measurement) const noexcept;
  double mean_velocity_rad_s(const JointMeasurement& measurement) const noexcept;
  void look_ahead() noexcept;
  double torque_before_Nm(int periods) const noexcept {
    return torques_Nm_[static_cast<std::size_t>(periods)];
  }

  StateEstimatorConfig config_;
  VelocityObserver observer_;
  JointModel adapted_;
  JointEstimate now_;
  JointEstimate then_;
  CurrentLoop current_loop_;
  double acting_Nm_ = 0.0;  ///< now, behind the current loop
  double acting_then_Nm_ = 0.0;
  std::array<double, kMaxControlDelay + 1> torques_Nm_{};  ///< newest first
  double previous_position_rad_ = 0.0;
  double steady_position_rad_ = 0.0;  ///< follows the reading with a play of a count to either side
  double previous_steady_rad_ = 0.0;
  double read_velocity_rad_s_ = 0.0;  ///< what the readings tell
  double usual_load_Nm_ = 0.0;        ///< at the start, then the observer's slow part: known without one
  int late_periods_ = 0;
  int still_periods_ = 0;
  bool first_ = true;
};

}  // namespace strainwave
