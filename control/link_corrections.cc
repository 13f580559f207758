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
// One that leaves more than this share of the distance was in vain: the next would do no better.
constexpr double kInVain = 0.7;
constexpr int kRestPeriodsLimit = 1 << 20;  // the count ends here

}  // namespace

bool LinkCorrections::begins(double reading_rad, double distance_rad, int still_periods) noexcept {
  rest_periods_ = std::min(rest_periods_ + 1, kRestPeriodsLimit);
  if (rest_periods_ * period_s_ <= kStands_s) {
    stands_at_rad_ = reading_rad;
  } else if (std::abs(reading_rad - stands_at_rad_) > kFlickerCounts * count_rad_) {
    corrections_ = kMost;
  }
  off_periods_ = distance_rad > kCorrectionCounts * count_rad_ ? off_periods_ + 1 : 0;
  const bool may_flicker =
      distance_rad <= kFlickerCounts * count_rad_ && off_periods_ * period_s_ < kFlicker_s;
  if (off_periods_ == 0 || may_flicker || still_periods < kStillPeriods) return false;
  if (corrections_ >= kMost || most_distrust_ > kTrusted) return false;
  const bool in_vain = begun() && distance_rad > kInVain * corrected_from_rad_;
  in_vain_ = begun() ? in_vain_ + (in_vain ? 1 : 0) : 0;
  if (in_vain_ >= kMostInVain) {
    corrections_ = kMost;
    return false;
  }
  corrected_from_rad_ = distance_rad;
  ++corrections_;
  return true;
}

}  // namespace strainwave
