// How PathFollower goes on after a stall of the loop. Real-time safe.
#include <algorithm>
#include <cmath>

#include "daemon/realtime/joint_loop.h"
#include "daemon/realtime/path_follower.h"

namespace strainwave {

namespace {

// A joint that was left alone goes on at most about twice as far as it was to, or comes back as far, and was late by less than the rest.
constexpr double kAhead = 2.0;
constexpr double kBack = 1.0;
constexpr double kMore_s = 0.1;
// So long a joint takes to come back to its path at least, and on average no faster than with this share of its speed limit.
constexpr double kLeastBack_s = 0.2;
constexpr double kBackSpeed = 0.05;

}  // namespace

// Where the path is nearest to the joints by now.
void PathFollower::find_path(std::size_t index) noexcept {
  Travel& travel = travels_[index];
  std::size_t count = 0;
  for_each_member(index, [&](JointLoop& joint, Member& member) {
    const PathPoint from = joint.goes_on_from();
    stray_[count++] = {
        &joint.path()->path, from.position_rad, from.velocity_rad_s, member.behind_periods * period_s_, {}};
  });
  const double away_s = static_cast<double>(travel.away_periods) * period_s_;
  const double last_s = std::min(travel.clock.time_s(), travel.duration_s);
  const PathTime now = nearest_time(std::span(stray_).first(count),
                                    {std::max(0.0, last_s - kBack * away_s - kMore_s),
                                     std::min(travel.duration_s, last_s + kAhead * away_s + kMore_s),
                                     {last_s, travel.clock.rate(), 0.0}});
  travel.clock.go_on_from(now);
  travel.times.go_on_from(now, period_s_);
  travel.away_periods = 0;
}

// Each has gone on from where it is for one period. False: the joints of the path were never left alone.
bool PathFollower::return_to_path(std::size_t index) noexcept {
  Travel& travel = travels_[index];
  if (travel.away_periods == 0) return false;
  find_path(index);
  travel.back_s = kLeastBack_s;
  const auto off_path = [&](JointLoop& joint, Member& member) {
    const PathTime then = travel.times.ago(member.behind_periods);
    const PathPoint on = in_path_time(member.reader.at(joint.path()->path, then.time_s), then);
    const PathPoint from = joint.goes_on_from();
    return PathPoint{from.position_rad - on.position_rad, from.velocity_rad_s - on.velocity_rad_s, 0.0};
  };
  for_each_member(index, [&](JointLoop& joint, Member& member) {
    member.reader = {};
    const double calm_rad_s = kBackSpeed * joint.motion_limits().velocity_rad_s;
    travel.back_s = std::max(travel.back_s, std::abs(off_path(joint, member).position_rad) / calm_rad_s);
  });
  for_each_member(index, [&](JointLoop& joint, Member& member) {
    const PathPoint off = off_path(joint, member);
    member.back.begin(off.position_rad, off.velocity_rad_s, travel.back_s);
  });
  return true;
}

}  // namespace strainwave
