// A joint's part of a path: JointLoop's methods that take it over, and do what daemon/realtime/path_follower.h tells. Real-time safe.
#include <cmath>

#include "daemon/realtime/joint_loop.h"

namespace strainwave {

namespace {
// A path begins where the joint holds. What it may be off is what the setpoint then catches up with.
constexpr double kBeginsWithin_rad = 1e-3;
}  // namespace

Ruling JointLoop::take_path(const Order& order) noexcept {
  if (mode_.is(Mode::kFaulted)) return Reason::kFaulted;
  const LoadedPath& offered = path_slots_.at(order.path_slot);
  const Ruling ruling = may_begin(offered);
  if (ruling.reason != Reason::kAccepted) return ruling;
  path_ = &offered;
  path_slots_.use(order.path_slot);
  return Reason::kAccepted;
}

Ruling JointLoop::may_begin(const LoadedPath& path) const noexcept {
  if (service_ == Service::kEnding) return Reason::kEnding;
  if (!zero_.known()) return Reason::kNotHomed;
  if (mode_.is(Mode::kTracking)) return Reason::kMoving;
  if (!mode_.is(Mode::kHolding)) return Reason::kWrongMode;
  const double begins_rad = zero_.to_drive_rad(path.path.knots[0].position_rad);
  const double off_rad = std::abs(begins_rad - controller_.trajectory().target_rad());
  if (!(off_rad <= kBeginsWithin_rad)) return {Reason::kOutOfRange, off_rad, kBeginsWithin_rad};
  return Reason::kAccepted;
}

void JointLoop::begin_path(const CycleTime& time) noexcept {
  (void)change_mode(ModeEvent::kSetpointAccepted, time);
  yield_.reset();
  const double end_rad = path_->path.last().position_rad;
  ordered_.begin_path(end_rad, zero_.to_drive_rad(end_rad));
}

void JointLoop::follow_path(const PathPoint& point, std::int64_t in_periods) noexcept {
  controller_.follow_path(zero_.to_drive_rad(point.position_rad), point.velocity_rad_s, in_periods,
                          reachable_range());
}

// The setpoint rests, or will where its limits kept it from resting by now.
void JointLoop::end_path() noexcept {
  ordered_.end();
  drop_path();
}

void JointLoop::stop_beside_path() noexcept {
  controller_.stop();
  end_path();
}

void JointLoop::drop_path() noexcept {
  path_ = nullptr;
  path_slots_.drop();
}

}  // namespace strainwave
