#include "control/rest_detector.h"

#include <algorithm>
#include <cmath>

namespace strainwave {

namespace {
// Samples without a count before a joint counts as still:
// slower than this it moves less than a count in their time.
constexpr int kStillSamples = 10;

constexpr double kReleaseCounts = 1.5;
}  // namespace

bool RestDetector::update(double distance_rad, double velocity_rad_s) noexcept {
  const double window_rad = std::max(resolution_rad_, kExactRestWindow_rad);
  const double distance = std::abs(distance_rad);
  const bool still = velocity_rad_s == 0.0 && distance <= window_rad;
  still_samples_ = still ? std::min(still_samples_ + 1, kStillSamples) : 0;
  resting_ = resting_ ? distance <= kReleaseCounts * window_rad : still_samples_ >= kStillSamples;
  return resting_;
}

}  // namespace strainwave
