#include "control/chatter_monitor.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace strainwave {

namespace {

// Shares of static friction. The law compensates 1.1 of it in either direction: a strong reversal is twice
// that. Less than half of it moves no joint that rests.
constexpr double kStrongShare = 2.5;
// A law that compensates none has no such reversals: one is then as strong as what moves the joint whichever way.
constexpr double kBareShare = 1.2;
constexpr double kWeakShare = 0.5;
// A reading may flicker by a count or two: the torque that this makes is noise. At rest a count to either side makes none
// (EstimateSource::kReadingsAtRest): what is as strong as half a step comes of more.
constexpr double kNoiseSteps = 4.0;
constexpr double kRestNoiseSteps = 0.5;
// As noise passes at most this share of the torque limit, on either side: gains that make more of a few counts shake the joint.
constexpr double kMostNoise = 0.25;
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
// Of the threshold beyond which the whole torque reverses: where the plan has reversed beyond so much, it has ordered what feedback and
// friction made more of.
constexpr double kOrderedShare = 0.5;
// Pushes of a landing reverse by design, and a first push may surprise; ten of them in 0.1 s do not on a sound
// joint. Half of a reversal would already make one of 2000 landings with friction off by up to 30 % fall back.
constexpr double kLandingWeight = 0.35;
// At rest the law's compensation of friction may hunt for the last counts, some 0.15 s at up to 100 reversals a
// second; what goes on longer does not settle soon.
constexpr double kSettled_s = 0.1;
constexpr double kRestLeak_s = 1.0;
constexpr double kRestLimit = 15.0;
// What follows a model of its spring answers every swing that a knock leaves, and is right to: it may for 0.5 s.
constexpr double kAnswerWeight = 0.25;
// With torques that move the joint whichever way, and not in one place, it does not settle by them: four such reversals in some 0.2 s.
constexpr double kShakenLeak_s = 0.3;
constexpr double kShakenLimit = 3.6;
constexpr double kShakenShare = 1.6;  // while friction is compensated, 1.1 of it
constexpr double kLeastShake = 0.03;  // of the torque limit: what shakes a joint without friction
// Slower than that, but for ever: what is compensated is more friction than the joint has. At two to five times of it the catalogue's
// joint reverses 20 to 40 times a second about its target. A sound joint that has been let rest for so long does not reverse at
// all; eight a second in the long run are more than somebody who pushes it makes.
constexpr double kUnsettled_s = 2.0;
constexpr double kUnsettledLeak_s = 5.0;
constexpr double kUnsettledLimit = 40.0;
// A joint that gives way before it slides swings within that by half of this torque, about whatever it carries, and friction does not end
// it: fifty reversals a second that go on half a second after the reference has come to rest are no hand and no hunting.
constexpr double kHum_s = 0.5;
constexpr double kHumShare = 0.25;
constexpr double kHumLimit = 50.0;  // with the leak of the level at rest
// Several times its own friction swings the catalogue's joint over its place and back 20 to 40 times a second, by milliradians. Two of that
// in 50 ms reach the limit; whoever pushes a joint out and lets it go makes one.
constexpr double kSwingLimit = 1.55;
// Distrust. With load and friction 30 % off, spring 25 %, delay by one, feedback asks for 0.14 of the limit up to 0.1 rad, and for 0.4 to
// 0.5 in motions of 1 rad on links of up to three times the motor.
constexpr double kDistrust_s = 0.05;
constexpr double kDistrustLimit = 0.5;
// After the fallback: what still counts as chatter, and how long it may last, half of it with the law's own gains. With the time to
// notice it no chatter lasts longer than half a second; on a long move it may begin only where the reference brakes.
constexpr double kGoesOn = 0.6;  // share of the limits
constexpr double kPatience_s = 0.2;

}  // namespace

ChatterMonitor::ChatterMonitor(double period_s) noexcept
    : period_s_(period_s),
      leak_(std::exp(-period_s / kLeak_s)),
      rest_leak_(std::exp(-period_s / kRestLeak_s)),
      shaken_leak_(std::exp(-period_s / kShakenLeak_s)),
      unsettled_leak_(std::exp(-period_s / kUnsettledLeak_s)),
      forget_(std::exp(-period_s / kDistrust_s)) {}

void ChatterMonitor::reset() noexcept {
  level_ = 0.0;
  turned_level_ = 0.0;
  rest_level_ = 0.0;
  shaken_level_ = 0.0;
  unsettled_level_ = 0.0;
  hum_level_ = 0.0;
  swing_level_ = 0.0;
  ordered_low_Nm_ = 0.0;
  ordered_high_Nm_ = 0.0;
  distrust_ = 0.0;
  chatter_s_ = 0.0;
  goes_on_ = false;
  drives_itself_ = false;
  rest_s_ = 0.0;
  strong_ = {};
  torque_ = {};
  plan_ = {};
  weak_ = {};
  shaken_ = {};
  hum_ = {};
  unordered_ = false;
  ordered_ = false;
  surprised_ = false;
  surprised_at_rest_ = false;
  state_ = MonitorState::kWatching;
}

bool ChatterMonitor::Side::reversed(double torque_Nm, double threshold_Nm) noexcept {
  if (!(std::abs(torque_Nm) > threshold_Nm)) return false;
  const int now = torque_Nm > 0.0 ? 1 : -1;
  return std::exchange(sign, now) == -now;
}

// The leak brings both ends back to where the torque is.
void ChatterMonitor::follow_orders(const ChatterSample& sample) noexcept {
  const double now_Nm = sample.ordered_torque_Nm;
  ordered_high_Nm_ = std::max(now_Nm, now_Nm + leak_ * (ordered_high_Nm_ - now_Nm));
  ordered_low_Nm_ = std::min(now_Nm, now_Nm + leak_ * (ordered_low_Nm_ - now_Nm));
}

void ChatterMonitor::count(const ChatterSample& sample) noexcept {
  surprised_ = surprised_ || sample.surprised;
  surprised_at_rest_ = surprised_at_rest_ || sample.surprised;
  rest_s_ = sample.reference_rests ? rest_s_ + period_s_ * sample.elapsed_periods : 0.0;
  const auto beyond_Nm = [&](double share, double steps = kNoiseSteps) {
    const double noise_Nm = std::min(steps * sample.feedback_step_Nm, kMostNoise * sample.torque_limit_Nm);
    return sample.doubt_Nm + std::max(share * sample.static_friction_Nm, noise_Nm);
  };
  const double strong_share = sample.compensates_friction ? kStrongShare : kBareShare;
  const double excess_Nm = sample.torque_Nm - sample.planned_torque_Nm;
  // At rest the law's compensation of friction is part of it: that is told from chatter as any other excess.
  const double turned_Nm = beyond_Nm(sample.reference_rests ? strong_share : kTurnedShare);
  const double explained_Nm = 0.5 * (ordered_high_Nm_ - ordered_low_Nm_);
  if (torque_.reversed(sample.torque_Nm, explained_Nm + turned_Nm) && !sample.landing) {
    turned_level_ += 1.0;
    unordered_ = true;
  }
  if (plan_.reversed(sample.planned_torque_Nm, kOrderedShare * turned_Nm)) ordered_ = true;
  if (unordered_ && ordered_ && torque_.sign == plan_.sign) {
    turned_level_ -= 1.0;
    unordered_ = ordered_ = false;
  }
  if (strong_.reversed(excess_Nm, explained_Nm + beyond_Nm(strong_share))) {
    if (!sample.landing)
      level_ += 1.0;
    else if (surprised_)
      level_ += kLandingWeight;
    surprised_ = false;
  }
  if (sample.turned_back) level_ += 1.0;
  if (sample.swung_over && sample.compensates_friction && !sample.landing && rest_s_ >= kSettled_s)
    swing_level_ += 1.0;
  const double moving_share = sample.compensates_friction ? kShakenShare : kBareShare;
  const double shaking_Nm =
      std::max(beyond_Nm(moving_share, kRestNoiseSteps), kLeastShake * sample.torque_limit_Nm);
  if (shaken_.reversed(excess_Nm, shaking_Nm) && !sample.landing && !sample.follows_model &&
      rest_s_ >= kSettled_s)
    shaken_level_ += 1.0;
  if (hum_.reversed(sample.torque_Nm - mean_torque_Nm_, beyond_Nm(kHumShare, kRestNoiseSteps)) &&
      !sample.landing && rest_s_ >= kHum_s)
    hum_level_ += 1.0;
  const bool weak = weak_.reversed(excess_Nm, beyond_Nm(kWeakShare, kRestNoiseSteps));
  if (!weak) return;
  if (!sample.landing && rest_s_ >= kSettled_s) rest_level_ += sample.follows_model ? kAnswerWeight : 1.0;
  if (rest_s_ >= kUnsettled_s)
    unsettled_level_ += !sample.landing ? 1.0 : surprised_at_rest_ ? kLandingWeight : 0.0;
  surprised_at_rest_ = false;
}

bool ChatterMonitor::any_level_reaches(double share) const noexcept {
  return level_ >= share * kLimit || turned_level_ >= share * kTurnedLimit ||
         rest_level_ >= share * kRestLimit || shaken_level_ >= share * kShakenLimit ||
         unsettled_level_ >= share * kUnsettledLimit || hum_level_ >= share * kHumLimit;
}

// From here on the gains are softer, and what counts is what those make.
void ChatterMonitor::doubt_the_gains() noexcept {
  goes_on_ = true;
  chatter_s_ = 0.5 * kPatience_s;
  level_ = turned_level_ = rest_level_ = shaken_level_ = unsettled_level_ = hum_level_ = 0.0;
}

MonitorState ChatterMonitor::step(const ChatterSample& sample) noexcept {
  for (int period = 0; period < sample.elapsed_periods; ++period) {
    level_ *= leak_;
    turned_level_ *= leak_;
    rest_level_ *= rest_leak_;
    shaken_level_ *= shaken_leak_;
    unsettled_level_ *= unsettled_leak_;
    hum_level_ *= rest_leak_;
    mean_torque_Nm_ += (1.0 - forget_) * (sample.torque_Nm - mean_torque_Nm_);
    swing_level_ *= leak_;
    follow_orders(sample);
    const double share = sample.torque_limit_Nm > 0.0
                             ? std::min(1.0, std::abs(sample.innovation_Nm) / sample.torque_limit_Nm)
                             : 0.0;
    distrust_ += (1.0 - forget_) * (share - distrust_);
  }
  count(sample);
  if (state_ == MonitorState::kWatching) {
    const bool drives_itself = swing_level_ >= kSwingLimit;
    if (!any_level_reaches(1.0) && distrust_ < kDistrustLimit && !drives_itself) return state_;
    const bool rests = rest_level_ >= kRestLimit || shaken_level_ >= kShakenLimit || hum_level_ >= kHumLimit;
    reset();
    drives_itself_ = drives_itself;
    if (rests) doubt_the_gains();
    state_ = MonitorState::kFallenBack;
    return state_;
  }
  const double elapsed_s = period_s_ * sample.elapsed_periods;
  chatter_s_ = any_level_reaches(kGoesOn)
                   ? chatter_s_ + elapsed_s
                   : std::max(goes_on_ ? 0.5 * kPatience_s : 0.0, chatter_s_ - elapsed_s);
  if (chatter_s_ >= 0.5 * kPatience_s && !goes_on_) doubt_the_gains();
  if (chatter_s_ >= kPatience_s) state_ = MonitorState::kFaultDue;
  return state_;
}

}  // namespace strainwave
