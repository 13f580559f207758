// What JointController does where the link hangs on the gear's spring: the motor's reference, and the last counts; and how a motion
// goes on from where the joint is.
#include <algorithm>
#include <cmath>

#include "control/joint_controller.h"
#include "control/units.h"

namespace strainwave {

namespace {

// A motion that is over before the wind-up has been built up asks it to turn round at once: three steps of the acceleration in the
// place of two (control/link_motion.h).
constexpr double kShortMotionShare = 2.0 / 3.0;
// From one reading to the next: a count to either side.
constexpr double kRestCounts = 2.0;
// What a joint swings about its place: 1 mrad at 40 Hz.
constexpr double kSwing_rad_s = 0.25;

}  // namespace

void JointController::advance_link(int elapsed_periods) noexcept {
  for (int period = 0; period < elapsed_periods; ++period) {
    limit_reference(plan_);
    limit_reference(ordered_);
    advance_references();
    planned_ = reference_;
    const double speed_rad_s = motor_plan_.acting_velocities_rad_s.back();
    const double taken_Nm = sign(speed_rad_s) * state_.model().friction_Nm(speed_rad_s) +
                            state_.now().disturbance.load_Nm + told_load_.torque_Nm +
                            told_load_.inertia_kgm2 * motor_plan_.wanted_acceleration_rad_s2;
    const auto available_Nm = [&](double along_rad_s) {
      return std::min(torque_limit_Nm_, config_.motor.available_Nm(along_rad_s));
    };
    motor_plan_ = link_motion_->step(
        planned_, {-available_Nm(-speed_rad_s) - taken_Nm, available_Nm(speed_rad_s) - taken_Nm}, taken_Nm);
  }
  reference_ = {motor_plan_.position_rad, motor_plan_.velocity_rad_s, motor_plan_.acting_acceleration_rad_s2};
  // A correction begins where the motor stands, and is no order.
  ordered_reference_ = !corrections_.begun() ? reference_ : Reference{rest_position_rad(), 0.0, 0.0};
}

// A motion to the target begins.
void JointController::plan_link_motion(double from_rad) noexcept {
  link_share_ = 1.0;
  const double spread_s = link_motion_->spread_s();
  const double covered_rad = present_limits(0.0).acceleration_rad_s2 * spread_s * spread_s;
  if (std::abs(plan_.target_rad() - from_rad) < covered_rad) link_share_ = kShortMotionShare;
}

// The reference is at rest. True when a motor that sticks off the target begins a motion of its own to it.
bool JointController::correct_link(double reading_rad) noexcept {
  if (!corrections_.begins(reading_rad, rest_position_rad() - reading_rad, state_.still_periods()))
    return false;
  ++replans_;
  corrects_ = true;
  law_.reference_jumps();
  const double from_rad = link_motion_->reset(reading_rad);
  plan_.go_on_from(from_rad, 0.0);
  planned_ = {};
  plan_link_motion(from_rad);
  state_.count_still_anew();
  return true;
}

// The motion that was under way, from where the joint is: the law alone cannot follow a link's plan, and nobody can one that went on
// while the loop was away for long.
void JointController::go_on_from_here() noexcept {
  const double fastest = config_.motion.velocity_rad_s;
  const double position_rad = state_.now().position_rad;
  // What two counts make of a joint that rests is no motion to brake, nor what swings one that was to rest.
  const double shown_rad_s = state_.now().velocity_rad_s;
  const double still_rad_s = std::max(kSwing_rad_s, kRestCounts * count_rad() / config_.period_s);
  const bool rests = (!torque_is_planned() || corrections_.begun()) && std::abs(shown_rad_s) <= still_rad_s;
  const double velocity_rad_s = rests ? 0.0 : std::clamp(shown_rad_s, -fastest, fastest);
  law_.reference_jumps();
  reference_ = {position_rad, velocity_rad_s, 0.0};
  ordered_reference_ = reference_;
  if (linked())
    plan_.go_on_from(link_motion_->reset(position_rad, velocity_rad_s), velocity_rad_s);
  else if (rests && !streamed())
    plan_.ease_from(position_rad, velocity_rad_s);
  else
    plan_.go_on_from(position_rad, velocity_rad_s);
  ordered_ = plan_;
  planned_ = {0.0, velocity_rad_s, 0.0};
  motor_plan_ = {};
  new_plans_.cancel();
}

// A motion after a stall over which nobody knows what the joint did. What it follows has gone on.
bool JointController::goes_on_anew() noexcept {
  if (!reference_moves()) return false;
  go_on_from_here();
  if (streamed())
    told_load_ = stream_.step().load;
  else
    stream_.wait(1);
  return true;
}

// Whether the torque is that of a motion.
bool JointController::torque_is_planned() const noexcept {
  if (linked()) return link_motion_->moves();
  return reference_.velocity_rad_s != 0.0 || reference_.acceleration_rad_s2 != 0.0;
}

}  // namespace strainwave
