// SPDX-License-Identifier: BSD-3-Clause
#include "commission/commissioning.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "commission/response.h"

namespace strainwave {

namespace {

// Least share of the ordered torque that a drive gives, in means over this time. Drives filter the reported torque for a shorter time.
constexpr double kGiven = 0.9;
constexpr double kReported_s = 0.02;

constexpr std::array<const char*, 6> kNames{"identity", "direction", "breakaway",
                                            "friction", "motion",    "comparison"};

std::string name_of(Commissioning::Step step) {
  return kNames.at(static_cast<std::size_t>(step));
}

ExcitationPart part_of(Commissioning::Step step) {
  switch (step) {
    case Commissioning::Step::kFriction:
      return ExcitationPart::kSteadyStrokes;
    case Commissioning::Step::kMotion:
      return ExcitationPart::kShakenStrokes;
    default:
      return ExcitationPart::kRamps;
  }
}

std::string text_of(const IntervalEstimate& estimate) {
  return fmt::format("{:.4g} +-{:.2g}", estimate.value, estimate.half_width_95);
}

/// "load_inertia_kgm2 0.1 configured, 0.102 +-0.001 measured, 0.102 used".
std::string text_of(const CommissionValue& value) {
  const std::string configured =
      value.configured ? fmt::format("{:.4g} configured, ", *value.configured) : "";
  return fmt::format("{} {}{} {} measured, {:.4g} used", value.key, configured, text_of(value.measured),
                     value.unit, value.used);
}

/// A drive that limits the torque makes the joint look heavier. Means are compared, since a drive may filter the reported torque.
std::string find_torque_that_is_not_given(const JointTrace& trace) {
  const double share = trace.period_s / (kReported_s + trace.period_s);
  double ordered_Nm = 0.0;
  double given_Nm = 0.0;
  double mean_ordered_Nm = 0.0;
  double mean_given_Nm = 0.0;
  bool measured = false;
  for (const JointSample& sample : trace.samples) {
    if (!std::isfinite(sample.torque_applied_Nm)) continue;
    measured = true;
    mean_ordered_Nm += share * (sample.torque_ordered_Nm - mean_ordered_Nm);
    mean_given_Nm += share * (sample.torque_applied_Nm - mean_given_Nm);
    ordered_Nm = std::max(ordered_Nm, std::abs(mean_ordered_Nm));
    given_Nm = std::max(given_Nm, std::abs(mean_given_Nm));
  }
  if (!measured || given_Nm >= kGiven * ordered_Nm) return "";
  return fmt::format(
      "the drive gave at most {:.1f} of the {:.1f} N.m ordered, in means over 20 ms: set torque_limit_Nm to "
      "what the drive can give",
      given_Nm, ordered_Nm);
}

/// Names of the numbers that a table needs and `motion` does not have.
std::string missing_in(const MotionEstimates& motion) {
  std::string names;
  const auto name = [&](const std::optional<IntervalEstimate>& found, const char* key) {
    if (!found) names += (names.empty() ? "" : ", ") + std::string(key);
  };
  name(motion.motor_inertia_kgm2, "motor_inertia_kgm2");
  name(motion.link_inertia_kgm2, "load_inertia_kgm2");
  name(motion.stiffness_1_Nm_rad, "stiffness_Nm_rad");
  return names;
}

}  // namespace

Commissioning::Commissioning(const CommissioningConfig& config, std::optional<CommissionRecord> before)
    : config_(config) {
  (void)plan_strokes(config.excitation);
  if (before && before->joint == config.joint && before->configuration_text == config.configuration_text)
    record_ = std::move(*before);
  std::erase_if(record_.steps, [](const CommissionStep& step) { return step.outcome != StepOutcome::kDone; });
  record_.joint = config.joint;
  record_.configuration = config.configuration;
  record_.configuration_text = config.configuration_text;
  record_.simulated = config.simulated;
  record_.problem.clear();
}

bool Commissioning::done(const std::string& name) const {
  return std::any_of(record_.steps.begin(), record_.steps.end(),
                     [&](const CommissionStep& step) { return step.name == name; });
}

std::optional<std::string> Commissioning::begin() {
  if (begun_) step_ = static_cast<Step>(static_cast<int>(step_) + 1);
  begun_ = true;
  if (step_ == Step::kEnd || !record_.problem.empty()) return std::nullopt;
  const bool pure = step_ == Step::kIdentity || step_ == Step::kComparison;
  // The motor may have been rewired since. Motion under feedback therefore needs ramps in the same run.
  const bool ramps = part_of(step_) == ExcitationPart::kRamps;
  const bool moves_later = !done(name_of(Step::kFriction)) || !done(name_of(Step::kMotion));
  resumed_ = !pure && done(name_of(step_)) && !(ramps && moves_later);
  if (!resumed_)
    std::erase_if(record_.steps, [&](const CommissionStep& s) { return s.name == name_of(step_); });
  const bool seen = step_ == Step::kBreakaway && !ramps_.samples.empty();
  if (!pure && !resumed_ && !seen) {
    ExcitationConfig motion = config_.excitation;
    motion.part = part_of(step_);
    excitation_ = std::make_unique<Excitation>(motion);
  }
  return announcement();
}

std::string Commissioning::announcement() const {
  const ExcitationLimits& limits = config_.excitation.limits;
  const std::string inside =
      fmt::format("{:.3f} to {:.3f} rad, at most {:.2f} rad/s and {:.1f} N.m", limits.position_min_rad,
                  limits.position_max_rad, limits.speed_rad_s, limits.torque_Nm);
  if (resumed_) return name_of(step_) + ": done before, not run again";
  switch (step_) {
    case Step::kIdentity:
      return "identity: comparisons at the start-up of the drive, nothing moves";
    case Step::kDirection:
      return "direction: ramps of torque until the joint moves, inside " + inside;
    case Step::kBreakaway:
      return excitation_ == nullptr ? std::string("breakaway: from the same ramps")
                                    : "breakaway: ramps of torque until the joint moves, inside " + inside;
    case Step::kFriction:
      return "friction: strokes at steady speeds, inside " + inside;
    case Step::kMotion:
      return "motion: strokes with an oscillating torque added, inside " + inside;
    default:
      return "comparison: of the configured with the measured values";
  }
}

ActuatorCommand Commissioning::step(const ActuatorReading& reading) {
  return excitation_ == nullptr ? ActuatorCommand{} : excitation_->step(reading);
}

void Commissioning::abort(const std::string& why) {
  if (excitation_ != nullptr) excitation_->abort(why);
  if ((excitation_ == nullptr || excitation_->ended()) && record_.problem.empty()) record_.problem = why;
}

std::string Commissioning::finish() {
  if (resumed_) {
    for (const CommissionStep& step : record_.steps)
      if (step.name == name_of(step_)) return step.name + ": " + step.text;
  }
  double time_s = 0.0;
  std::string failure = record_.problem;
  if (excitation_ != nullptr) {
    const JointTrace& trace = excitation_->trace();
    time_s = trace.time_s(trace.samples.size());
    record_.joint_time_s += time_s;
    for (const JointSample& sample : trace.samples)
      if (std::isfinite(sample.temperature_C)) record_.temperature_C = sample.temperature_C;
    JointTrace& kept = part_of(step_) == ExcitationPart::kRamps ? ramps_ : strokes_;
    if (kept.samples.empty())
      kept = trace;
    else  // the joint rests between the two traces
      kept.samples.insert(kept.samples.end(), trace.samples.begin(), trace.samples.end());
    if (failure.empty()) failure = excitation_->problem();
    if (failure.empty()) failure = find_torque_that_is_not_given(trace);
    excitation_.reset();
  }
  // A trace up to an abort may show one direction or speed only. Therefore only a complete step gives results.
  std::string text;
  if (failure.empty()) text = evaluate();
  if (!failure.empty()) {
    if (step_ == Step::kDirection && failure.find("the other way") != std::string::npos)
      failure = config_.direction_key + ": " + failure;
    record_.problem = failure;
  }
  const bool good = record_.problem.empty();
  record_.steps.push_back({name_of(step_), good ? StepOutcome::kDone : StepOutcome::kFailed,
                           good ? text : record_.problem, time_s});
  if (!good)
    for (int later = static_cast<int>(step_) + 1; later < static_cast<int>(Step::kEnd); ++later)
      if (!done(name_of(static_cast<Step>(later))))
        record_.steps.push_back({name_of(static_cast<Step>(later)), StepOutcome::kSkipped,
                                 "not run, since " + name_of(step_) + " ended early", 0.0});
  return name_of(step_) + (good ? ": " + text : ": ended early: " + record_.problem);
}

std::string Commissioning::evaluate() {
  switch (step_) {
    case Step::kIdentity:
      return config_.identity;
    case Step::kDirection:
      return find_which_way();
    case Step::kBreakaway:
      return find_torque_of_breaking_away();
    case Step::kFriction:
      return find_friction_over_speed();
    case Step::kMotion:
      return find_motion();
    case Step::kComparison:
      return compare();
    case Step::kEnd:
      break;
  }
  return "";
}

std::string Commissioning::find_which_way() {
  if (!record_.temperature_C) {
    record_.problem = "no temperature came, and friction depends on it: connect the sensor";
    return "";
  }
  const std::optional<int> direction = find_direction(ramps_);
  if (!direction)
    record_.problem = "the motion is too small to show which way the torque acts: is the brake open?";
  else if (*direction < 0)
    record_.problem = config_.direction_key + ": positive torque moves the joint to smaller positions";
  return "positive torque moves the joint to larger positions";
}

std::string Commissioning::find_torque_of_breaking_away() {
  const auto both = find_breakaway(ramps_, config_.told.gear_ratio);
  record_.breakaway_positive_Nm = both[0];
  record_.breakaway_negative_Nm = both[1];
  if (!both[0] || !both[1]) {
    record_.problem = "the joint did not break away in both directions: is something in its way?";
    return "";
  }
  return fmt::format("{} N.m measured to larger positions, {} N.m to smaller ones", text_of(*both[0]),
                     text_of(*both[1]));
}

std::string Commissioning::find_friction_over_speed() {
  record_.friction = find_friction(strokes_, friction_search(config_.told.gear_ratio, std::nullopt));
  if (record_.friction.empty()) {
    record_.problem =
        "no stretch of steady speed was long enough: give a larger range between the position limits, attach "
        "the load, or remove a weight that friction can hardly hold";
    return "";
  }
  std::string text = "measured, before the inertia is known:";
  for (const FrictionAtSpeed& point : record_.friction)
    text += fmt::format("{} {} N.m at {:.3f} rad/s", text.back() == ':' ? "" : ",", text_of(point.torque_Nm),
                        point.speed_rad_s);
  return text;
}

std::string Commissioning::find_motion() {
  const std::optional<MotionEstimates> found = fit_motion(strokes_, config_.told);
  if (!found) {
    record_.problem =
        "the model of the configured joint does not fit the motion: check gear and gear_ratio; if they are "
        "right, give a larger range, speed or torque limit";
    return "";
  }
  record_.values = compare_with(config_.configured, *found);
  record_.response = measure_response(strokes_, config_.told.gear_ratio);
  record_.kinematic_error_rad = {found->kinematic_error_rad[0].value, found->kinematic_error_rad[1].value};
  record_.model.reset();
  if (found->motor_inertia_kgm2 && found->link_inertia_kgm2 && found->stiffness_1_Nm_rad)
    record_.model = {found->motor_inertia_kgm2->value, found->link_inertia_kgm2->value,
                     found->stiffness_1_Nm_rad->value,
                     found->damping_Nms_rad ? found->damping_Nms_rad->value : 0.0,
                     found->delay_s.value + 0.5 * strokes_.period_s};
  else
    record_.problem = fmt::format(
        "{}: not known to 5 %, since the link hardly swings: give a larger range, speed or torque limit, or "
        "attach the load; with a load below a third of the motor's inertia, take them from data sheets",
        missing_in(*found));
  // Friction again, without the accelerating torque. If the steady strokes are of an earlier run, this finds fewer speeds and is not used.
  if (const std::vector<FrictionAtSpeed> friction =
          find_friction(strokes_, friction_search(config_.told.gear_ratio, found));
      friction.size() >= record_.friction.size())
    record_.friction = friction;
  std::string text;
  for (const CommissionValue& value : record_.values) text += (text.empty() ? "" : "; ") + text_of(value);
  return text;
}

std::string Commissioning::compare() {
  record_.problem = find_wrong(record_.values, config_.told.gear_ratio);
  if (record_.problem.empty()) record_.problem = find_late(record_.values);
  return "no configured number differs from the measured one by 30 % or more";
}

}  // namespace strainwave
