// When a joint has come to rest at its target, as far as the encoder can tell. With hysteresis: rest begins
// within one count of the target after the reading has stood still, and ends only with a new target or real
// motion away from it. Real-time safe.
#pragma once

namespace strainwave {

/// Where exact sensing, which has no counts, takes a joint to be at its target.
inline constexpr double kExactRestWindow_rad = 1e-6;

class RestDetector {
 public:
  /// `resolution_rad`: one count; 0: exact sensing.
  explicit RestDetector(double resolution_rad) noexcept : resolution_rad_(resolution_rad) {}

  void reset() noexcept {
    still_samples_ = 0;
    resting_ = false;
  }
  /// One sample: where the joint is from its target, and its velocity as measured. Whether it rests.
  bool update(double distance_rad, double velocity_rad_s) noexcept;

 private:
  double resolution_rad_;
  int still_samples_ = 0;
  bool resting_ = false;
};

}  // namespace strainwave
