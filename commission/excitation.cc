// SPDX-License-Identifier: BSD-3-Clause
#include "commission/excitation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/input_error.h"
#include "base/units.h"
#include "commission/motion_spans.h"

namespace strainwave {

namespace {

// Sliding takes between this share of the breakaway torque, when warm, and almost all of it, when cold (data/friction_parameters.csv).
constexpr double kSlidingShare = 0.5;
// Duration of a ramp to the torque limit. The torque then rises little between breakaway and the first count that shows it.
constexpr double kRamp_s = 3.0;
constexpr std::size_t kRamps = 4;  // twice each way
// Bandwidth of the speed loop. Its speed is a mean over 32 periods, which suppresses the gear's resonance.
constexpr double kBandwidth_rad_s = 10.0;
constexpr double kIntegral_per_s = 4.0;
// Share of the torque against stiction that is kept for the motion that follows.
constexpr double kStickingShare = 0.25;
// Ratio to the planned speed from which a joint is too fast.
constexpr double kTooFast = 1.4;
// Largest total inertia over the configured motor inertia. The motor may have three times that, and the load three times the motor's.
constexpr double kMostInertia = 12.0;
constexpr std::size_t kMean = 32;
constexpr std::size_t kQuickMean = 8;
// Root mean square of the acceleration in the first shaken stroke, for a joint with twice the configured motor inertia.
constexpr double kFirstShake_rad_s2 = 4.0;
// Three standard deviations of the speed's swing take this share of the difference between the stroke's speed and sliding speed.
constexpr double kSwingShare = 0.8;
constexpr double kBraked_rad_s = 0.01;
constexpr double kLongestBraking_s = 1.5;
// Share of the speed limit. A joint that gains this much speed while it is braked has a feedback of the wrong sign.
constexpr double kRunsAway = 0.25;
// Share of the torque limit at which a joint that sticks is blocked.
constexpr double kBlocked = 0.95;
// Share of the torque limit. A joint that moves against a smaller torque falls, or is moved from outside.
constexpr double kFalls = 0.01;

}  // namespace

Excitation::Excitation(const ExcitationConfig& config)
    : config_(config),
      guard_(config.limits, config.period_s),
      quick_speed_(config.period_s, kQuickMean),
      mean_speed_(config.period_s, kMean),
      strokes_(plan_strokes(config)),
      trace_{config.period_s, config.encoder_resolution_rad, {}},
      inertia_kgm2_(2.0 * config.motor_inertia_kgm2),
      sines_(config.period_s),
      shake_rms_Nm_(kFirstShake_rad_s2 * inertia_kgm2_) {
  trace_.samples.reserve(static_cast<std::size_t>(config.longest_s / config.period_s));
}

void Excitation::begin_braking() {
  stage_ = Stage::kBraking;
  stage_periods_ = 0;
  planned_rad_s_ = 0.0;
  braked_from_rad_s_ = std::abs(quick_rad_s_);
}

bool Excitation::runs_away() const {
  return std::abs(quick_rad_s_) > braked_from_rad_s_ + kRunsAway * config_.limits.speed_rad_s;
}

void Excitation::abort(const std::string& why) {
  if (stage_ == Stage::kDone) return;
  if (problem_.empty()) problem_ = why;
  if (stage_ == Stage::kBraking) return;
  begin_braking();
  hold_Nm_ = {};
}

ActuatorCommand Excitation::step(const ActuatorReading& reading) {
  if (stage_ == Stage::kDone) return {};
  const double speed = mean_speed_.step(reading.joint_position_rad);
  quick_rad_s_ = quick_speed_.step(reading.joint_position_rad);
  const bool braked = stage_ == Stage::kBraking;
  const std::optional<std::string> wrong = guard_.judge(reading, quick_rad_s_, true);
  const bool runs = braked && runs_away();
  if (wrong && (!braked || guard_.blind())) abort(*wrong);
  if (runs) abort("the joint speeds up while it is braked");
  // In these cases the drive is disabled at once instead of braking the joint. While the holding brake opens, the torque stays 0.
  const bool obeys = reading.drive_state == DriveState::kEnabled && !reading.brake_shut;
  if (reading.fault != ActuatorFault::kNone || guard_.blind() || runs ||
      (stage_ == Stage::kBraking && !obeys)) {
    stage_ = Stage::kDone;
    return {};
  }
  ++stage_periods_;
  double torque = 0.0;
  if (obeys)
    torque = std::clamp(torque_Nm(reading.joint_position_rad, speed), -config_.limits.torque_Nm,
                        config_.limits.torque_Nm);
  if (stage_ == Stage::kDone) return {};
  record(reading, torque);
  return {torque, true};
}

double Excitation::torque_Nm(double position_rad, double speed_rad_s) {
  switch (stage_) {
    case Stage::kEnabling:
      stage_ = config_.part == ExcitationPart::kAll || config_.part == ExcitationPart::kRamps
                   ? Stage::kBreakingAway
                   : Stage::kStroking;
      stage_periods_ = 0;
      return 0.0;
    case Stage::kBreakingAway:
      return ramp_Nm(position_rad);
    case Stage::kStroking:
    case Stage::kReturning:
      return stroke_Nm(position_rad, speed_rad_s);
    case Stage::kBraking:
      if (std::abs(speed_rad_s) < kBraked_rad_s ||
          static_cast<double>(stage_periods_) * config_.period_s > kLongestBraking_s)
        stage_ = Stage::kDone;
      return follow_Nm(speed_rad_s, 0.0);
    case Stage::kDone:
      break;
  }
  return 0.0;
}

/// Raises the torque until the joint slides, lets it stop, and repeats this the other way.
double Excitation::ramp_Nm(double position_rad) {
  const double way = done_ % 2 == 0 ? 1.0 : -1.0;
  const long rest = std::lround(0.25 / config_.period_s);
  if (stage_periods_ <= rest) {  // the joint comes to rest
    if (done_ == 0 && std::abs(quick_rad_s_) > sliding_speed_rad_s(config_.gear_ratio))
      abort(fmt::format("the joint moves without torque at {:.4f} rad: it falls, or something moves it",
                        position_rad));
    return 0.0;
  }
  const double torque = way * config_.limits.torque_Nm * config_.period_s / kRamp_s *
                        static_cast<double>(stage_periods_ - rest);
  if (std::abs(torque) > kBlocked * config_.limits.torque_Nm) {
    abort(
        fmt::format("the joint has not moved at {:.2f} N.m of the allowed {:.2f} N.m: is the brake open? If "
                    "it is, give a larger torque_limit_Nm, or warm the joint",
                    torque, config_.limits.torque_Nm));
    return 0.0;
  }
  if (std::abs(quick_rad_s_) < sliding_speed_rad_s(config_.gear_ratio)) return torque;
  if (quick_rad_s_ * way < 0.0 && std::abs(torque) < kFalls * config_.limits.torque_Nm) {
    abort(fmt::format(
        "the joint falls, or something moves it: at {:.2f} N.m it moves against the torque at {:.4f} rad",
        torque, position_rad));
    return 0.0;
  }
  if (quick_rad_s_ * way < 0.0) {
    abort(fmt::format(
        "a torque of {:.2f} N.m moves the joint the other way at {:.4f} rad; a falling load does the same",
        torque, position_rad));
    return 0.0;
  }
  hold_Nm_[way > 0.0 ? 0 : 1] = kSlidingShare * torque;
  ++done_;
  stage_periods_ = 0;
  if (done_ == kRamps) {
    stage_ = Stage::kStroking;
    if (strokes_.empty()) begin_braking();
    done_ = 0;
  }
  return 0.0;
}

double Excitation::stroke_Nm(double position_rad, double speed_rad_s) {
  const Stroke stroke = stage_ == Stage::kReturning
                            ? Stroke{config_.start_rad, strokes_.front().speed_rad_s, false}
                            : strokes_[done_];
  const double left = stroke.to_rad - position_rad;
  const double way = left > 0.0 ? 1.0 : -1.0;
  const double most = config_.limits.acceleration_rad_s2;
  // From this speed, half of the allowed acceleration brakes the joint to rest at the target.
  const double wanted = way * std::min(stroke.speed_rad_s, std::sqrt(most * std::abs(left)));
  const double before = planned_rad_s_;
  planned_rad_s_ += std::clamp(wanted - before, -most * config_.period_s, most * config_.period_s);
  // At this distance half of the speed is left, and the next stroke begins.
  if (std::abs(left) < stroke.speed_rad_s * stroke.speed_rad_s / (4.0 * most)) {
    next_stroke();
    return follow_Nm(speed_rad_s, 0.0);
  }
  const double torque = follow_Nm(speed_rad_s, (planned_rad_s_ - before) / config_.period_s);
  if (!stroke.shaken || std::abs(planned_rad_s_) < 0.999 * stroke.speed_rad_s) return torque;
  const double shaken = torque + shake_Nm(position_rad);
  if (std::abs(quick_rad_s_) < 0.5 * sliding_speed_rad_s(config_.gear_ratio)) sines_.forget_repetition();
  sines_.respond(shaken, quick_rad_s_);
  return shaken;
}

void Excitation::next_stroke() {
  stage_periods_ = 0;
  if (stage_ == Stage::kReturning) {
    begin_braking();
    return;
  }
  if (strokes_[done_].shaken) adapt_shaking();
  if (++done_ == strokes_.size()) stage_ = Stage::kReturning;
}

/// Torque that drives the joint to the planned speed. One integral for each direction of motion holds friction and load. A joint that
/// sticks gets an additional torque, which rises as in a ramp until the joint slides.
double Excitation::follow_Nm(double speed_rad_s, double acceleration_rad_s2) {
  const double gain = inertia_kgm2_ * kBandwidth_rad_s;
  const double error = planned_rad_s_ - speed_rad_s;
  if (planned_rad_s_ == 0.0) return gain * error;
  const double way = planned_rad_s_ > 0.0 ? 1.0 : -1.0;
  const double feedback = gain * error + inertia_kgm2_ * acceleration_rad_s2;
  const double slides = 0.5 * sliding_speed_rad_s(config_.gear_ratio);
  // Friction brakes a joint that still moves the other way, or much too fast. Therefore only the load is held.
  const double load = 0.5 * (hold_Nm_[0] + hold_Nm_[1]);
  if (quick_rad_s_ * way < -slides) return load + feedback;
  double& hold = hold_Nm_[way > 0.0 ? 0 : 1];
  const double limit = config_.limits.torque_Nm;
  if (std::abs(quick_rad_s_) < slides) {
    sticking_Nm_ += way * limit * config_.period_s / kRamp_s;
    if (std::abs(hold + sticking_Nm_) > kBlocked * limit)
      abort(
          fmt::format("the joint does not move at {:.1f} N.m: something is in its way, or the encoder stands "
                      "still",
                      hold + sticking_Nm_));
  } else {
    hold += kStickingShare * sticking_Nm_ + gain * kIntegral_per_s * error * config_.period_s;
    sticking_Nm_ = 0.0;
  }
  hold = std::clamp(hold, -limit, limit);
  if (quick_rad_s_ * way > slides + kTooFast * std::abs(planned_rad_s_)) return load + feedback;
  return hold + sticking_Nm_ + feedback;
}

double Excitation::shake_Nm(double position_rad) {
  // The mean speed over two periods. A longer mean would hide part of a fast resonance.
  const JointSample& before = trace_.samples[trace_.samples.size() - 2];
  const double speed_rad_s = (position_rad - before.motor_position_rad) / (2.0 * config_.period_s);
  shake_squares_ += std::pow(speed_rad_s - planned_rad_s_, 2);
  ++shaken_periods_;
  return shake_rms_Nm_ * sines_.step();
}

/// After a shaken stroke, scales the shaking to the swing that the next stroke's speed allows.
void Excitation::adapt_shaking() {
  sines_.restart();
  if (const std::optional<double> inertia = sines_.inertia_kgm2())
    inertia_kgm2_ =
        std::clamp(*inertia, config_.motor_inertia_kgm2, kMostInertia * config_.motor_inertia_kgm2);
  if (shaken_periods_ < 100) return;
  const double swing = std::sqrt(shake_squares_ / static_cast<double>(shaken_periods_));
  const double room = strokes_[std::min(done_ + 1, strokes_.size() - 1)].speed_rad_s -
                      sliding_speed_rad_s(config_.gear_ratio);
  const double factor = std::clamp(kSwingShare * room / (3.0 * swing), 0.3, 2.5);
  shake_rms_Nm_ = std::min(factor * shake_rms_Nm_, 0.15 * config_.limits.torque_Nm);
  shake_squares_ = 0.0;
  shaken_periods_ = 0;
}

void Excitation::record(const ActuatorReading& reading, double torque_Nm) {
  if (trace_.samples.size() == trace_.samples.capacity())
    return abort(
        fmt::format("the measurement took more than the allowed {:.0f} s: give a larger speed_limit_rad_s or "
                    "a smaller range",
                    config_.longest_s));
  JointSample sample;
  sample.motor_position_rad = reading.joint_position_rad;
  if (reading.has_link_position) sample.link_position_rad = reading.link_position_rad;
  sample.torque_ordered_Nm = torque_Nm;
  if (reading.torque_measured) sample.torque_applied_Nm = reading.torque_applied_Nm;
  if (reading.has_temperature) sample.temperature_C = reading.temperature_C;
  trace_.samples.push_back(sample);
}

}  // namespace strainwave
