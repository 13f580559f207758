// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/path/path_follower.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "daemon/realtime/joint/joint_loop.h"

namespace strainwave {

PathFollower::PathFollower(std::span<const std::unique_ptr<JointLoop>> joints, double period_s)
    : joints_(joints), period_s_(period_s), members_(joints.size()), travels_(joints.size()) {
  for (const auto& joint : joints_) joint->joint().follower = this;
}

template <typename Act>
void PathFollower::for_each_member(std::size_t travel, const Act& act) noexcept {
  for (std::size_t joint = 0; joint < members_.size(); ++joint)
    if (members_[joint].travel == travel) act(joints_[joint]->joint(), members_[joint]);
}

Ruling PathFollower::resume(std::size_t joint) noexcept {
  const std::optional<std::size_t> travel = members_[joint].travel;
  if (!travel) return begin(joint);
  travels_[*travel].clock.run();
  return Reason::kAccepted;
}

Ruling PathFollower::begin(std::size_t first) noexcept {
  const LoadedPath* path = joints_[first]->joint().path;
  if (path == nullptr) return Reason::kWrongMode;
  const auto takes_part = [&](std::size_t joint) {
    const LoadedPath* part = joints_[joint]->joint().path;
    return part != nullptr && !members_[joint].travel && part->id == path->id &&
           part->joint_count == path->joint_count;
  };
  std::int32_t parts = 0;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    if (!takes_part(joint)) continue;
    const Ruling ruling = may_begin_path(joints_[joint]->joint(), *joints_[joint]->joint().path);
    if (ruling.reason != Reason::kAccepted) return ruling;
    ++parts;
  }
  if (parts != path->joint_count)
    return {Reason::kWrongMode, static_cast<double>(parts), static_cast<double>(path->joint_count)};
  Travel& travel = travels_[first];
  travel = {};
  travel.phase = Phase::kBeginning;
  for (std::size_t joint = 0; joint < joints_.size(); ++joint) {
    if (!takes_part(joint)) continue;
    members_[joint] = {};
    members_[joint].travel = first;
    travel.duration_s = std::max(travel.duration_s, joints_[joint]->joint().path->path.duration_s());
  }
  return Reason::kAccepted;
}

Ruling PathFollower::pause(std::size_t joint) noexcept {
  const std::optional<std::size_t> travel = members_[joint].travel;
  if (!travel) return Reason::kWrongMode;
  travels_[*travel].clock.rest();
  return Reason::kAccepted;
}

void PathFollower::advance(const CycleTime& time) noexcept {
  for (std::size_t travel = 0; travel < travels_.size(); ++travel)
    if (travels_[travel].phase != Phase::kFree) advance(travel, time);
}

// Checks again, because orders and faults may have come after the order to begin, in the same cycle.
bool PathFollower::begin_all(std::size_t travel, const CycleTime& time) noexcept {
  bool all = true;
  for_each_member(travel, [&](JointInLoop& joint, Member&) {
    all = all && joint.path != nullptr && may_begin_path(joint, *joint.path).reason == Reason::kAccepted;
  });
  if (!all) return false;
  for_each_member(travel, [&](JointInLoop& joint, Member&) {
    (void)joint.change_mode(ModeEvent::kSetpointAccepted, time);
    joint.yield.reset();
    const double end_rad = joint.path->path.last().position_rad;
    joint.ordered.begin_path(end_rad, joint.zero.to_drive_rad(end_rad));
  });
  wait_for_the_slowest(travel);
  travels_[travel].phase = Phase::kUnderWay;
  return true;
}

void PathFollower::wait_for_the_slowest(std::size_t travel) noexcept {
  double slowest_s = 0.0;
  double fastest_s = std::numeric_limits<double>::infinity();
  for_each_member(travel, [&](JointInLoop& joint, Member&) {
    slowest_s = std::max(slowest_s, joint.law.controller().plan().lead_s());
    fastest_s = std::min(fastest_s, joint.law.controller().plan().lead_s());
  });
  for_each_member(travel, [&](JointInLoop& joint, Member& member) {
    member.behind_periods = (slowest_s - joint.law.controller().plan().lead_s()) / period_s_;
  });
  travels_[travel].most_behind_periods = (slowest_s - fastest_s) / period_s_;
}

void PathFollower::advance(std::size_t index, const CycleTime& time) noexcept {
  Travel& travel = travels_[index];
  const bool begins = travel.phase == Phase::kBeginning;
  if (begins && !begin_all(index, time)) return free(index);
  if (time.elapsed_periods > kMaxElapsedPeriods || has_lost_one(index)) return stop_each(index);
  for (std::int64_t period = 0; period < time.elapsed_periods; ++period) {
    travel.clock.advance(period_s_, travel.clock.steady() ? PathClock::kMostRoom : room(index));
    travel.times.note(travel.clock.now());
  }
  for_each_member(index, [&](JointInLoop& joint, Member& member) {
    const PathTime now = travel.times.ago(member.behind_periods);
    const Reference on = in_path_time(member.reader.at(joint.path->path, now.time_s), now);
    joint.law.controller().follow_path(joint.zero.to_drive_rad(on.position_rad), on.velocity_rad_s,
                                       time.elapsed_periods, joint.reachable_range());
    // The path time that belongs to the setpoint in the same state: the reference lags by one period and lead_s().
    const double later_periods = 1.0 + joint.law.controller().plan().lead_s() / period_s_;
    const PathTime shown = travel.times.ago(member.behind_periods + later_periods);
    joint.ordered.note({shown.time_s, travel.clock.is_to_rest() && shown.rate == 0.0});
  });
  if (travel.times.ago(travel.most_behind_periods).time_s < travel.duration_s) return;
  for_each_member(index, [](JointInLoop& joint, Member&) { joint.end_orders(); });
  free(index);
}

// Stops the joints that are still on the path.
void PathFollower::stop_each(std::size_t travel) noexcept {
  for_each_member(travel, [](JointInLoop& joint, Member&) {
    if (!joint.ordered.on_path()) return;
    joint.law.controller().stop();
    joint.end_orders();
  });
  free(travel);
}

bool PathFollower::has_lost_one(std::size_t travel) noexcept {
  bool lost = false;
  for_each_member(travel, [&](JointInLoop& joint, Member&) { lost = lost || !joint.ordered.on_path(); });
  return lost;
}

RateRoom PathFollower::room(std::size_t index) noexcept {
  const PathClock& clock = travels_[index].clock;
  RateRoom all = PathClock::kMostRoom;
  for_each_member(index, [&](JointInLoop& joint, Member& member) {
    PathReader ahead = member.reader;
    const KnotPath& path = joint.path->path;
    const Reference here = ahead.at(path, clock.time_s());
    const Reference next = ahead.at(path, clock.time_s() + period_s_ * clock.rate());
    all = all.both(rate_room(here, next, clock.rate(), joint.config.controller.motion));
  });
  return all;
}

void PathFollower::free(std::size_t travel) noexcept {
  for_each_member(travel, [](JointInLoop&, Member& member) { member.travel.reset(); });
  travels_[travel].phase = Phase::kFree;
}

}  // namespace strainwave
