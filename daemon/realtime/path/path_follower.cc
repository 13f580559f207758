// SPDX-License-Identifier: BSD-3-Clause
#include "daemon/realtime/path/path_follower.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "daemon/realtime/joint/joint_loop.h"

namespace strainwave {

namespace {

// For coming to rest along the path: a multiple of what the slowest joint needs on its own, and what the clock needs of the slowest path.
constexpr double kPatience = 2.0;

}  // namespace

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
  const std::size_t travel = members_[joint].travel;
  if (travel == kNoTravel) return begin(joint);
  if (travels_[travel].phase == Phase::kEnding) return Reason::kWrongMode;
  travels_[travel].clock.run();
  return Reason::kAccepted;
}

Ruling PathFollower::begin(std::size_t first) noexcept {
  const LoadedPath* path = joints_[first]->joint().path;
  if (path == nullptr) return Reason::kWrongMode;
  const auto takes_part = [&](std::size_t joint) {
    const LoadedPath* part = joints_[joint]->joint().path;
    return part != nullptr && members_[joint].travel == kNoTravel && part->id == path->id &&
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
  const std::size_t travel = members_[joint].travel;
  if (travel == kNoTravel || travels_[travel].phase == Phase::kEnding) return Reason::kWrongMode;
  travels_[travel].clock.rest();
  return Reason::kAccepted;
}

bool PathFollower::end(std::size_t joint) noexcept {
  const std::size_t travel = members_[joint].travel;
  if (travel == kNoTravel) return false;
  if (travels_[travel].phase == Phase::kBeginning) {
    free(travel);
    return false;
  }
  bring_to_rest(travel);
  return true;
}

void PathFollower::advance(const CycleTime& time) noexcept {
  for (std::size_t travel = 0; travel < travels_.size(); ++travel)
    if (travels_[travel].phase != Phase::kFree) advance(travel, time);
}

// Orders and faults may have come in the cycle of the order to begin.
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
  if (time.elapsed_periods > kMaxElapsedPeriods) return stop_each(index);
  if (begins && !begin_all(index, time)) return free(index);
  if (!release_lost(index)) return stop_each(index);
  for (std::int64_t period = 0; period < time.elapsed_periods; ++period) {
    travel.clock.advance(period_s_, travel.clock.steady() ? PathClock::kMostRoom : room(index));
    travel.times.note(travel.clock.now());
  }
  const bool ending = travel.phase == Phase::kEnding;
  for_each_member(index, [&](JointInLoop& joint, Member& member) {
    const PathTime now = travel.times.ago(member.behind_periods);
    const PathPoint on = in_path_time(member.reader.at(joint.path->path, now.time_s), now);
    joint.law.controller().follow_path(joint.zero.to_drive_rad(on.position_rad), on.velocity_rad_s,
                                       time.elapsed_periods, joint.reachable_range());
    // Of the setpoint in the same state: the reference reaches the present point one period later, or more.
    const double later_periods = 1.0 + joint.law.controller().plan().lead_s() / period_s_;
    const PathTime shown = travel.times.ago(member.behind_periods + later_periods);
    joint.ordered.note({shown.time_s, !ending && travel.clock.is_to_rest() && shown.rate == 0.0});
  });
  if (is_over(index)) {
    for_each_member(index, [](JointInLoop& joint, Member&) { joint.end_orders(); });
    return free(index);
  }
  if (travel.phase == Phase::kEnding && (travel.rest_cycles -= time.elapsed_periods) <= 0) stop_each(index);
}

// Of one that ends early all joints are on it until all rest: what is to stop with them waits for that.
bool PathFollower::is_over(std::size_t index) noexcept {
  const Travel& travel = travels_[index];
  const PathTime last = travel.times.ago(travel.most_behind_periods);
  const bool arrived = last.time_s >= travel.duration_s;
  if (travel.phase != Phase::kEnding) return arrived;
  bool all_rest = arrived || (travel.clock.rests() && last.rate == 0.0);
  for_each_member(index,
                  [&](JointInLoop& joint, Member&) { all_rest = all_rest && joint.law.motion().at_target; });
  return all_rest;
}

void PathFollower::stop_each(std::size_t travel) noexcept {
  for_each_member(travel, [](JointInLoop& joint, Member&) {
    joint.law.controller().stop();
    joint.end_orders();
  });
  free(travel);
}

// A joint that faulted, was disabled or got another order has left the path, and the path ends.
// False: its other joints are to stop at once.
bool PathFollower::release_lost(std::size_t travel) noexcept {
  bool lost = false;
  bool at_once = false;
  for_each_member(travel, [&](JointInLoop& joint, Member& member) {
    if (joint.ordered.on_path()) return;
    member.travel = kNoTravel;
    lost = true;
    at_once = at_once || joint.others_stop() == OthersStop::kAtOnce;
  });
  if (lost && !at_once) bring_to_rest(travel);
  return !at_once;
}

void PathFollower::bring_to_rest(std::size_t index) noexcept {
  Travel& travel = travels_[index];
  travel.clock.rest();
  if (travel.phase == Phase::kEnding) return;
  double longest_s = 0.0;
  for_each_member(index, [&](JointInLoop& joint, Member& member) {
    if (joint.path == nullptr) return;
    joint.ordered.path_ends();
    PathReader reader = member.reader;
    const PathPoint here = reader.at(joint.path->path, travel.clock.time_s());
    longest_s = std::max(longest_s,
                         std::abs(here.velocity_rad_s) / joint.config.controller.motion.deceleration_rad_s2);
  });
  travel.rest_cycles = std::llround(
      kPatience * (longest_s + 1.0 / PathClock::kFastestChange_1_s) / period_s_ + travel.most_behind_periods);
  travel.phase = Phase::kEnding;
}

RateRoom PathFollower::room(std::size_t index) noexcept {
  const PathClock& clock = travels_[index].clock;
  RateRoom all = PathClock::kMostRoom;
  for_each_member(index, [&](JointInLoop& joint, Member& member) {
    PathReader ahead = member.reader;
    const KnotPath& path = joint.path->path;
    const PathPoint here = ahead.at(path, clock.time_s());
    const PathPoint next = ahead.at(path, clock.time_s() + period_s_ * clock.rate());
    all = all.both(rate_room(here, next, clock.rate(), joint.config.controller.motion));
  });
  return all;
}

void PathFollower::free(std::size_t travel) noexcept {
  for_each_member(travel, [](JointInLoop&, Member& member) { member.travel = kNoTravel; });
  travels_[travel].phase = Phase::kFree;
}

}  // namespace strainwave
