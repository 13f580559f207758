// What JointLoop makes of its motion each period: limits that it is at, and faults. Real-time safe.
#include <cmath>

#include "daemon/realtime/joint_loop.h"
#include "lcmtypes/oscillation_evidence.h"

namespace strainwave {

namespace {

/// A speed this close to its limit is at it.
constexpr double kAtLimit = 1.0 - 1e-9;
/// Of the estimated inertia, beside kInertiaApart.
constexpr double kCertainDeviations = 3.0;

}  // namespace

// By the torque that was commanded last. A brake holds whatever the torque.
void JointLoop::estimate_inertia(const JointMeasurement& measurement) noexcept {
  if (!measurement.has_position || measurement.elapsed_periods != 1 || measurement.late_periods != 0 ||
      mode_.is(Mode::kReleasing))
    return inertia_.interrupt();
  inertia_.step({measurement.joint_position_rad, motion_.output.torque_Nm,
                 config_.controller.gravity.at(measurement.joint_position_rad)},
                controller_.loaded_model());
}

bool JointLoop::shows_other_inertia() const noexcept {
  const std::optional<double> shown_kgm2 = inertia_.inertia_kgm2();
  const double told_kgm2 = controller_.loaded_model().inertia_kgm2;
  return shown_kgm2 && std::abs(*shown_kgm2 - told_kgm2) >
                           kInertiaApart * told_kgm2 + kCertainDeviations * inertia_.deviation_kgm2();
}

void JointLoop::note_limits(const JointMeasurement& measurement) noexcept {
  if (motion_.output.saturated) notice(Notice::kTorqueLimited);
  if (motion_.off_stream) notice(Notice::kOffStream);
  if (shows_other_inertia()) notice(Notice::kOtherInertia);
  const FuzzyFriction& friction = table_->table.friction;
  if (motion_.gains_in_use == GainsInUse::kFallback)
    notice(Notice::kFallbackGains);
  else if (measurement.temperature_C < friction.temperature_min_C ||
           measurement.temperature_C > friction.temperature_max_C)
    notice(Notice::kTemperatureClamped);
  const double speed_limit_rad_s = config_.controller.motion.velocity_rad_s;
  if (std::abs(motion_.reference.velocity_rad_s) >= kAtLimit * speed_limit_rad_s)
    notice(Notice::kSpeedLimited);
}

// With what was seen of it: who reads the fault need not guess.
void JointLoop::raise_oscillation(const CycleTime& time) noexcept {
  const OscillationDetector& seen = controller_.oscillation();
  const double configured_kgm2 = controller_.loaded_model().inertia_kgm2;
  const double shown_kgm2 = inertia_.inertia_kgm2().value_or(0.0);
  raise_fault(Fault::kChatter, time,
              evidence_number({seen.reversals_per_s(), seen.swing_Nm(), shown_kgm2 / configured_kgm2}));
}

void JointLoop::check_motion(const CycleTime& time) noexcept {
  if (!mode_.controlled()) return;
  const JointLimits& limits = config_.limits;
  const double position_rad = reading().joint_position_rad;
  const double joint_rad = zero_.to_joint_rad(position_rad);
  if (zero_.known() && (joint_rad < limits.position_min_rad - limits.position_margin_rad ||
                        joint_rad > limits.position_max_rad + limits.position_margin_rad))
    return raise_fault(Fault::kPositionLimit, time);
  if (!mode_.is(Mode::kHoming) && into_limit_switch(motion_.reference.velocity_rad_s))
    return raise_fault(Fault::kLimitSwitch, time);
  if (motion_.oscillates) return raise_oscillation(time);
  // What it is yielding to pushes on as fast as it may be pushed.
  if (std::abs(motion_.joint_velocity_rad_s) > limits.overspeed_rad_s)
    return raise_fault(controller_.yields() ? Fault::kOverload : Fault::kSpeedLimit, time);
  // Until the brake is open the joint stands whatever it is ordered.
  if (mode_.is(Mode::kReleasing)) return motion_watch_.begin(position_rad, time.now_ns);
  const Fault fault = motion_watch_.judge(motion_, position_rad, time.now_ns);
  if (motion_watch_.high_load()) notice(Notice::kLoadHigh);
  if (fault == Fault::kOverload)
    stop_overloaded(time);
  else if (fault != Fault::kNone)
    raise_fault(fault, time);
  if (motion_watch_.off_target(mode_.is(Mode::kHolding), position_rad - controller_.rest_position_rad(),
                               time.now_ns))
    notice(Notice::kOffTarget);
}

// It yields once to what pushes it: a load that does not let go, or is back as soon as the joint is held again, is a fault.
void JointLoop::stop_overloaded(const CycleTime& time) noexcept {
  const bool may_hold = config_.overload_stop == OverloadStop::kHoldLoad && !mode_.is(Mode::kHoming);
  if (!may_hold || controller_.yields() || motion_watch_.has_just_yielded(time.now_ns))
    return raise_fault(Fault::kOverload, time);
  yield_ = {motion_.load_Nm, motion_watch_.loads().load_Nm, zero_.to_joint_rad(reading().joint_position_rad)};
  yielded_stream_ = ordered_.stream_id();
  (void)events_.push({index_, time.cycle, mode(), mode(), Fault::kNone, 0, yield_});
  ordered_.end();
  drop_path();
  controller_.yield(motion_watch_.usual_load_Nm());
}

}  // namespace strainwave
