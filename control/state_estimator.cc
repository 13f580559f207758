#include "control/state_estimator.h"

#include <algorithm>
#include <cassert>

#include "control/link_velocity.h"

namespace strainwave {

namespace {

// What is known of the load without an observer is its estimate's mean over about this time: longer than a spring swings.
constexpr double kUsualLoad_s = 0.1;
// To either side: three neighbouring readings with a bit for rounding.
constexpr double kPlayCounts = 1.01;

// Of a count in a period: what is left of a smoothed velocity of readings that have stopped changing.
constexpr double kFaded = 0.01;
constexpr double kLeastMotion_rad = 1e-12;

}  // namespace

StateEstimator::StateEstimator(const StateEstimatorConfig& config) noexcept
    : config_(config),
      observer_(config.observer),
      current_loop_(config.current_loop_s, config.observer.period_s) {
  assert(config.delay_periods >= 0 && config.delay_periods <= kMaxControlDelay);
}

void StateEstimator::reset(double position_rad, double velocity_rad_s, double load_Nm,
                           double friction_scale_Nm) noexcept {
  observer_.reset(position_rad, friction_scale_Nm, velocity_rad_s, load_Nm);
  torques_Nm_.fill(load_Nm);
  acting_Nm_ = acting_then_Nm_ = load_Nm;
  previous_position_rad_ = position_rad;
  steady_position_rad_ = previous_steady_rad_ = position_rad;
  read_velocity_rad_s_ = velocity_rad_s;
  usual_load_Nm_ = load_Nm;
  late_periods_ = 0;
  still_periods_ = 0;
  first_ = true;
}

void StateEstimator::step(const JointMeasurement& measurement, const JointModel& model, EstimateSource source,
                          SurpriseCause cause) noexcept {
  if (measurement.elapsed_periods > kMaxElapsedPeriods && !first_) begin_anew(measurement, model);
  const int elapsed_periods = std::clamp(measurement.elapsed_periods, 1, kMaxElapsedPeriods);
  // Before the first period nothing has acted yet.
  const int most_late = kMaxControlDelay - config_.delay_periods;
  const int waiting = waiting_torques(measurement);
  let_torque_act(first_ ? 0 : elapsed_periods, std::clamp(measurement.late_periods, 0, most_late), waiting,
                 model, source, cause);
  first_ = false;
  const double position_rad = measurement.joint_position_rad;
  still_periods_ = position_rad == previous_position_rad_
                       ? std::min(still_periods_ + elapsed_periods, kMaxElapsedPeriods)
                       : 0;
  follow_reading(position_rad);
  adapted_ = model;
  JointMeasurement believed = measurement;
  believed.has_position = measurement.has_position && measurement.late_periods <= most_late;
  if (source == EstimateSource::kObserver)
    observe(believed, cause);
  else
    read(measurement, source);
  previous_position_rad_ = position_rad;
  then_ = now_;
  if (source == EstimateSource::kObserver) look_ahead();
}

// What is left is what two readings tell.
void StateEstimator::begin_anew(const JointMeasurement& measurement, const JointModel& model) noexcept {
  const double position_rad = measurement.joint_position_rad;
  const double velocity_rad_s = mean_velocity_rad_s(measurement);
  observer_.reset(position_rad, model.friction_scale_Nm, velocity_rad_s, usual_load_Nm_);
  read_velocity_rad_s_ = velocity_rad_s;
  first_ = true;
}

double StateEstimator::elapsed_s(const JointMeasurement& measurement) const noexcept {
  return std::max(1, measurement.elapsed_periods) * config_.observer.period_s;
}

double StateEstimator::mean_velocity_rad_s(const JointMeasurement& measurement) const noexcept {
  return (measurement.joint_position_rad - previous_position_rad_) / elapsed_s(measurement);
}

void StateEstimator::remember(double torque_Nm) noexcept {
  std::copy_backward(torques_Nm_.begin(), torques_Nm_.end() - 1, torques_Nm_.end());
  torques_Nm_.front() = torque_Nm;
}

// A drive that has not sampled its position over periods that were left out was not told to, nor to take the next torque. What is left of the
// delay once positions have theirs is what its torques wait.
int StateEstimator::waiting_torques(const JointMeasurement& measurement) const noexcept {
  const int skipped = measurement.elapsed_periods - 1;
  const int later = measurement.late_periods - late_periods_;
  if (skipped <= 0 || later <= 0) return 0;
  const int of_positions = std::max(0, skipped - later);
  return std::max(0, config_.delay_periods - 1 - of_positions);
}

// By a period: the torque that acts, which is the newest but so many.
void StateEstimator::prolong(int waiting) noexcept {
  std::copy_backward(torques_Nm_.begin() + waiting, torques_Nm_.end() - 1, torques_Nm_.end());
}

// From the last position's sampling to this one's, fewer periods have passed when positions become late, and more when they
// catch up.
void StateEstimator::let_torque_act(int periods, int late_periods, int waiting, const JointModel& model,
                                    EstimateSource source, SurpriseCause cause) noexcept {
  const auto predict = [&](int late) {
    const double torque_Nm = torque_before_Nm(config_.delay_periods + late);
    if (source == EstimateSource::kObserver)
      observer_.predict(current_loop_.mean_Nm(torque_Nm, acting_Nm_), model, cause);
    acting_Nm_ = current_loop_.end_Nm(torque_Nm, acting_Nm_);
  };
  const int later = late_periods - late_periods_;
  for (int period = 0; period < periods; ++period) {
    if (period > 0) prolong(waiting);
    if (period < periods - later) predict(late_periods_);
  }
  for (int late = late_periods_ - 1; late >= late_periods; --late) predict(late);
  late_periods_ = late_periods;
}

void StateEstimator::observe(const JointMeasurement& measurement, SurpriseCause cause) noexcept {
  if (measurement.has_velocity && config_.observer.encoder_resolution_rad == 0.0)
    observer_.correct_exactly(measurement.joint_position_rad, measurement.joint_velocity_rad_s);
  else if (measurement.has_position)
    observer_.correct(measurement.joint_position_rad, cause);
  now_ = observer_.estimate();
  adapted_.inertia_kgm2 *= now_.inertia_ratio;
  usual_load_Nm_ += (now_.disturbance.load_Nm - usual_load_Nm_) * config_.observer.period_s / kUsualLoad_s;
}

void StateEstimator::follow_reading(double position_rad) noexcept {
  const double play_rad = kPlayCounts * config_.observer.encoder_resolution_rad;
  previous_steady_rad_ = steady_position_rad_;
  steady_position_rad_ = std::clamp(steady_position_rad_, position_rad - play_rad, position_rad + play_rad);
}

void StateEstimator::read(const JointMeasurement& measurement, EstimateSource source) noexcept {
  now_ = {};
  now_.position_rad = measurement.joint_position_rad;
  const double mean_rad_s = source == EstimateSource::kReadingsAtRest
                                ? (steady_position_rad_ - previous_steady_rad_) / elapsed_s(measurement)
                                : mean_velocity_rad_s(measurement);
  read_velocity_rad_s_ = smoothed(read_velocity_rad_s_, mean_rad_s, config_.velocity_share,
                                  std::clamp(measurement.elapsed_periods, 1, kMaxElapsedPeriods));
  // A mean that fades never ends by itself, and what rests moves by exactly nothing.
  const double least_rad = std::max(kFaded * config_.observer.encoder_resolution_rad, kLeastMotion_rad);
  if (mean_rad_s == 0.0 && std::abs(read_velocity_rad_s_) * config_.observer.period_s < least_rad)
    read_velocity_rad_s_ = 0.0;
  const bool measured = measurement.has_velocity && config_.velocity_share == 1.0;
  now_.velocity_rad_s = measured ? measurement.joint_velocity_rad_s : read_velocity_rad_s_;
  now_.disturbance.load_Nm = usual_load_Nm_;
}

// The torques that are under way already decide the motion until this period's torque acts.
void StateEstimator::look_ahead() noexcept {
  acting_then_Nm_ = acting_Nm_;
  for (int i = config_.delay_periods + late_periods_ - 1; i >= 0; --i) {
    const double torque_Nm = torque_before_Nm(i);
    const ModelMotion motion =
        adapted_.advance(current_loop_.mean_Nm(torque_Nm, acting_then_Nm_), then_.disturbance,
                         then_.velocity_rad_s, config_.observer.period_s);
    acting_then_Nm_ = current_loop_.end_Nm(torque_Nm, acting_then_Nm_);
    then_.position_rad += motion.displacement_rad;
    then_.velocity_rad_s = motion.velocity_rad_s;
  }
}

}  // namespace strainwave
