#include "control/chatter_monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strainwave {

namespace {

// Shares of static friction. The law compensates 1.1 of it in either direction: a strong reversal is twice
// that. Less than half of it moves no joint that rests.
constexpr double kStrongShare = 2.5;
constexpr double kWeakShare = 0.5;
// A reading may flicker by a count or two: the torque that this makes is noise.
constexpr double kNoiseSteps = 4.0;
// A strain-wave joint on its spring swings at 28 to 86 Hz (catalogue stiffness, load up to three times the
// rotor): 56 to 172 reversals a second. Four of them in 50 ms reach the limit, and so do 40 a second in the
// long run; a move has three, a push from outside two.
constexpr double kLeak_s = 0.1;
constexpr double kLimit = 3.3;
// A plan that needs all of the torque leaves nothing to see beyond it on its own side. There the whole torque is looked at: five
// reversals that no plan orders in 50 ms reach the limit. A certified law on a hardly damped spring may make four where a motion
// begins to brake, while friction that moves, 1.5 of static friction at most, cannot make one.
constexpr double kTurnedShare = 1.5;
constexpr double kTurnedLimit = 3.9;
// Pushes of a landing reverse by design, and a first push may surprise; ten of them in 0.1 s do not on a sound
// joint. Half of a reversal would already make one of 2000 landings with friction off by up to 30 % fall back.
constexpr double kLandingWeight = 0.35;
// At rest the law's compensation of friction may hunt for the last counts, some 0.5 s at up to 100 reversals a
// second; what goes on longer does not settle.
constexpr double kSettled_s = 0.1;
constexpr double kRestLeak_s = 1.0;
constexpr double kRestLimit = 60.0;
// Slower than that, but for ever: what is compensated is more friction than the joint has. At two to five times of it the catalogue's
// joint reverses 20 to 40 times a second about its target. A sound joint that has been let rest for so long does not reverse at
// all; eight a second in the long run are more than somebody who pushes it makes.
constexpr double kUnsettled_s = 2.0;
constexpr double kUnsettledLeak_s = 5.0;
constexpr double kUnsettledLimit = 40.0;
// After the fallback: what still counts as chatter, and how long it may last. With the time to notice it no chatter lasts longer
// than some third of a second; on a long move it may begin only where the reference brakes.
constexpr double kGoesOn = 0.6;  // share of the limits
constexpr double kPatience_s = 0.25;

}  // namespace

ChatterMonitor::ChatterMonitor(double period_s) noexcept
    : period_s_(period_s),
      leak_(std::exp(-period_s / kLeak_s)),
      rest_leak_(std::exp(-period_s / kRestLeak_s)),
      unsettled_leak_(std::exp(-period_s / kUnsettledLeak_s)) {}

void ChatterMonitor::reset() noexcept {
  level_ = 0.0;
  turned_level_ = 0.0;
  rest_level_ = 0.0;
  unsettled_level_ = 0.0;
  chatter_s_ = 0.0;
  rest_s_ = 0.0;
  strong_ = {};
  torque_ = {};
  plan_ = {};
  weak_ = {};
  surprised_ = false;
  surprised_at_rest_ = false;
  state_ = MonitorState::kWatching;
}

bool ChatterMonitor::Side::reversed(double torque_Nm, double threshold_Nm) noexcept {
  if (!(std::abs(torque_Nm) > threshold_Nm)) return false;
  const int now = torque_Nm > 0.0 ? 1 : -1;
  return std::exchange(sign, now) == -now;
}

void ChatterMonitor::count(const ChatterSample& sample) noexcept {
  surprised_ = surprised_ || sample.surprised;
  surprised_at_rest_ = surprised_at_rest_ || sample.surprised;
  rest_s_ = sample.reference_rests ? rest_s_ + period_s_ * sample.elapsed_periods : 0.0;
  const auto beyond_Nm = [&](double share) {
    return sample.doubt_Nm +
           std::max(share * sample.static_friction_Nm, kNoiseSteps * sample.feedback_step_Nm);
  };
  const double excess_Nm = sample.torque_Nm - sample.planned_torque_Nm;
  // At rest the law's compensation of friction is part of it: that is told from chatter as any other excess.
  const double turned_Nm = beyond_Nm(sample.reference_rests ? kStrongShare : kTurnedShare);
  if (torque_.reversed(sample.torque_Nm, turned_Nm) && !sample.landing) turned_level_ += 1.0;
  if (plan_.reversed(sample.planned_torque_Nm, turned_Nm)) turned_level_ -= 1.0;
  if (strong_.reversed(excess_Nm, beyond_Nm(kStrongShare))) {
    if (!sample.landing)
      level_ += 1.0;
    else if (surprised_)
      level_ += kLandingWeight;
    surprised_ = false;
  }
  const bool weak = weak_.reversed(excess_Nm, beyond_Nm(kWeakShare));
  if (!weak) return;
  if (!sample.landing && rest_s_ >= kSettled_s) rest_level_ += 1.0;
  if (rest_s_ >= kUnsettled_s)
    unsettled_level_ += !sample.landing ? 1.0 : surprised_at_rest_ ? kLandingWeight : 0.0;
  surprised_at_rest_ = false;
}

bool ChatterMonitor::any_level_reaches(double share) const noexcept {
  return level_ >= share * kLimit || turned_level_ >= share * kTurnedLimit ||
         rest_level_ >= share * kRestLimit || unsettled_level_ >= share * kUnsettledLimit;
}

MonitorState ChatterMonitor::step(const ChatterSample& sample) noexcept {
  for (int period = 0; period < sample.elapsed_periods; ++period) {
    level_ *= leak_;
    turned_level_ *= leak_;
    rest_level_ *= rest_leak_;
    unsettled_level_ *= unsettled_leak_;
  }
  count(sample);
  if (state_ == MonitorState::kWatching) {
    if (!any_level_reaches(1.0)) return state_;
    reset();
    state_ = MonitorState::kFallenBack;
    return state_;
  }
  const double elapsed_s = period_s_ * sample.elapsed_periods;
  chatter_s_ = any_level_reaches(kGoesOn) ? chatter_s_ + elapsed_s : std::max(0.0, chatter_s_ - elapsed_s);
  if (chatter_s_ >= kPatience_s) state_ = MonitorState::kFaultDue;
  return state_;
}

}  // namespace strainwave
