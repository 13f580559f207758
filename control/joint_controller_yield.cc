// What JointController takes for the load that pushes the joint, and how it yields to one.
#include <algorithm>
#include <cmath>

#include "control/joint_controller.h"

namespace strainwave {

namespace {

// Without an observer the load is what the feedback has asked for in the mean over about this time: longer than a count's torque lasts.
constexpr double kWeigh_s = 0.01;
// So long the joint stands, or what pushed it has let go, before it is brought to rest.
constexpr double kLetGo_s = 0.02;
// A joint that stays within so many counts of a place stands there.
constexpr double kStillCounts = 3.0;

}  // namespace

// At rest the held torque has it all in it.
void JointController::weigh(const ControllerOutput& output, int elapsed_periods) noexcept {
  const JointDisturbance& known = state_.now().disturbance;
  if (observing()) {
    shown_load_Nm_ = known.load_Nm;
    return;
  }
  // Without an observer nobody sees what still pushes a joint that yields.
  if (yields()) {
    shown_load_Nm_ = yielding_.load_Nm;
    return;
  }
  const double besides_Nm = phase_ == MotionPhase::kTracking ? output.torque_Nm - output.feedforward_torque_Nm
                                                             : hold_torque_Nm_ - estimated_load_Nm();
  const double share = 1.0 - std::exp(-elapsed_periods * config_.period_s / kWeigh_s);
  shown_load_Nm_ += share * (known.load_Nm + besides_Nm - shown_load_Nm_);
}

double JointController::holding_torque_Nm() const noexcept {
  return shown_load_Nm_ + config_.gravity.at(state_.now().position_rad) + told_load_.torque_Nm;
}

void JointController::yield(double load_Nm, double let_go_Nm) noexcept {
  follows_ = Follows::kTarget;
  yielding_ = {load_Nm, let_go_Nm, state_.now().position_rad, 0};
  new_plans_.cancel();
  law_.interrupt();
  enter(MotionPhase::kYielding);
}

// The reference is where the joint is.
void JointController::go_on_yielding(int elapsed_periods) noexcept {
  const double position_rad = state_.now().position_rad;
  const double velocity_rad_s = state_.now().velocity_rad_s;
  const double still_rad = kStillCounts * count_rad();
  const bool moves = std::abs(position_rad - yielding_.stands_at_rad) > still_rad;
  if (moves) yielding_.stands_at_rad = position_rad;
  const bool let_go = observing() && std::abs(shown_load_Nm_) <= yielding_.let_go_Nm;
  yielding_.periods = let_go || !moves ? yielding_.periods + elapsed_periods : 0;
  if (yielding_.periods * config_.period_s < kLetGo_s) {
    reference_ = {position_rad, 0.0, 0.0};
    ordered_reference_ = reference_;
    return;
  }
  start(position_rad, velocity_rad_s, yielding_.load_Nm + config_.gravity.at(position_rad));
  // In a period that has been read already: the next reading is one period of this velocity farther, and so is the reference.
  state_.has_been_read();
  advance_reference(1);
}

}  // namespace strainwave
