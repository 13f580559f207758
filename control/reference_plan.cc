#include "control/reference_plan.h"

namespace strainwave {

void ReferencePlan::begin(double position_rad, double velocity_rad_s) noexcept {
  mean_is_ = unasked_;
  shaper_.reset(ahead_of(position_rad, velocity_rad_s), velocity_rad_s);
}

void ReferencePlan::go_on_from(double position_rad, double velocity_rad_s) noexcept {
  shaper_.restart(ahead_of(position_rad, velocity_rad_s), velocity_rad_s);
}

void ReferencePlan::ease_from(double position_rad, double velocity_rad_s) noexcept {
  if (mean_is_ != Mean::kAlways) mean_is_ = Mean::kEasing;
  go_on_from(position_rad, velocity_rad_s);
}

void ReferencePlan::ease() noexcept {
  mean_is_ = Mean::kEasing;
  mean_.reset(shaper_.position_rad(), 0.0);
}

void ReferencePlan::end_easing() noexcept {
  if (mean_is_ != Mean::kEasing) return;
  shaper_.restart(mean_.position_rad(), mean_.velocity_rad_s());
  mean_is_ = unasked_;
}

void ReferencePlan::begin_path() noexcept {
  if (unasked_ != Mean::kPaused) return end_easing();
  if (wants_easing()) ease();
}

}  // namespace strainwave
