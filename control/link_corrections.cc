#include "control/link_corrections.h"

#include <cmath>

namespace strainwave {

namespace {

// Periods that the reading stands before the motor is taken to stick; at the speed of one count in them it would stop in
// less than a count.
constexpr int kStillPeriods = 3;
// Farther from its place than this a motor at rest moves once more. One count is what its encoder cannot tell.
constexpr double kCorrectionCounts = 1.2;
// A count may flicker: what may be off by no more than one beside it has to be so for this time on end.
constexpr double kFlickerCounts = 2.2;
constexpr double kFlicker_s = 0.02;
// A motor that has come to rest stands soon. A reading that moves by more than a flicker so long after the motion is of a link that
// swings behind it, or of a motor that the integral moves: neither is corrected from rest.
constexpr double kStands_s = 0.1;
// One that leaves more than this share of the distance was in vain.
constexpr double kInVain = 0.7;
// What the first that brings nothing adds to the model's friction, as a share of it. Of friction that is 30 % off the second then moves. Half
// of it once one has gone too far: a motor that sticks answers to little more friction with all of the way.
constexpr double kLearning = 0.2;
constexpr double kLearningLess = 0.5;
constexpr int kRestPeriodsLimit = 1 << 20;  // the count ends here

}  // namespace

// What the last correction has left of its way is what friction has taken of it.
void LinkCorrections::learn(double off_rad) noexcept {
  if (!begun()) {
    learning_ = kLearning;
    last_left_ = 0.0;
    return;
  }
  const double left = std::clamp(off_rad / corrected_from_rad_, -1.0, 1.0);
  if (left * last_left_ < 0.0) learning_ *= kLearningLess;
  last_left_ = left;
  friction_doubt_ = std::clamp(friction_doubt_ + learning_ * left, -kMostFrictionDoubt, kMostFrictionDoubt);
}

bool LinkCorrections::begins(double reading_rad, double off_rad, int still_periods) noexcept {
  rest_periods_ = std::min(rest_periods_ + 1, kRestPeriodsLimit);
  if (rest_periods_ * period_s_ <= kStands_s) {
    stands_at_rad_ = reading_rad;
  } else if (std::abs(reading_rad - stands_at_rad_) > kFlickerCounts * count_rad_) {
    corrections_ = kMost;
  }
  const double distance_rad = std::abs(off_rad);
  off_periods_ = distance_rad > kCorrectionCounts * count_rad_ ? off_periods_ + 1 : 0;
  const bool may_flicker =
      distance_rad <= kFlickerCounts * count_rad_ && off_periods_ * period_s_ < kFlicker_s;
  if (off_periods_ == 0 || may_flicker || still_periods < kStillPeriods) return false;
  if (corrections_ >= kMost || most_distrust_ > kTrusted) return false;
  const bool in_vain = begun() && distance_rad > kInVain * std::abs(corrected_from_rad_);
  in_vain_ = begun() ? in_vain_ + (in_vain ? 1 : 0) : 0;
  if (in_vain_ >= kMostInVain) {
    corrections_ = kMost;
    return false;
  }
  learn(off_rad);
  corrected_from_rad_ = off_rad;
  ++corrections_;
  return true;
}

}  // namespace strainwave
