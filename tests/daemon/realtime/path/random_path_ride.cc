// SPDX-License-Identifier: BSD-3-Clause
#include "tests/daemon/realtime/path/random_path_ride.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <strainwave/path_v1.hpp>
#include <utility>

#include "tests/support/wire_message.h"

namespace strainwave::testing {

namespace {

constexpr std::int64_t kSession = 4711;
constexpr std::int64_t kChallenge = 815;
constexpr double kPeriod_s = 0.001;
constexpr int kAfter = 500;  // cycles
/// From rest to the full rate of a path's time and back takes 0.1 s, and what accelerations besides leave of it.
constexpr double kBackAtFullRate_s = 0.25;
/// What rounding leaves of a velocity that is 0.
constexpr double kStands_rad_s = 1e-13;

std::string name_of(std::size_t joint) {
  return "joint" + std::to_string(joint);
}

std::vector<JointAdmission> admissions(const std::vector<BenchJoint>& joints) {
  std::vector<JointAdmission> result;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointControllerConfig& controller = joints[i].loop.controller;
    const JointLimits& limits = joints[i].loop.limits;
    JointAdmission joint;
    joint.name = name_of(i);
    joint.path = {{limits.position_min_rad, limits.position_max_rad},
                  controller.motion,
                  controller.torque_limit_Nm,
                  joints[i].loop.limits.load.usual.accelerating_Nm / controller.motion.acceleration_rad_s2,
                  controller.period_s};
    result.push_back(joint);
  }
  return result;
}

}  // namespace

std::string Farthest::text() const {
  char text[128];
  std::snprintf(text, sizeof text, "%.3g (joint %zu, %.3f s, %.3f rad/s)", value, joint, time_s,
                velocity_rad_s);
  return text;
}

RandomPathRide::RandomPathRide(const std::vector<BenchJoint>& joints, const GainTable& table)
    : configs_(joints),
      bench_(joints),
      admission_("SW", kSession, admissions(joints), {{}, /*unsigned_allowed=*/true}) {
  admission_.advance(0, kChallenge);
  for (std::size_t i = 0; i < joints.size(); ++i) bench_.bring_to_hold(i, table);
}

std::string RandomPathRide::offer(std::size_t joint, const DrawnPart& part) {
  path_v1 message{};
  message.session_id = kSession;
  message.challenge = kChallenge;
  message.sender_id = 1;
  message.sequence = ++sequence_;
  message.path_id = 7;
  message.joint_count = static_cast<std::int32_t>(configs_.size());
  message.knot_count = static_cast<std::int32_t>(part.size());
  for (std::size_t i = 0; i < part.size(); ++i) {
    message.time_s[i] = part[i].time_s;
    message.position_rad[i] = part[i].position_rad;
    message.velocity_rad_s[i] = part[i].velocity_rad_s;
  }
  const Verdict verdict = admission_.consider(wire("SW." + name_of(joint) + ".PATH", message), 0);
  if (verdict.kind != Verdict::Kind::kOrder) return verdict.text.empty() ? "discarded" : verdict.text;
  const auto slot = bench_.joint(joint).path_slots().hand_over(*verdict.path);
  if (!slot) return "no slot";
  const Reason reason = bench_.order(joint, Order{.kind = OrderKind::kLoadPath, .path_slot = *slot});
  return reason == Reason::kAccepted ? "" : "by the loop: " + std::to_string(static_cast<int>(reason));
}

double RandomPathRide::moves_rad() {
  std::vector<std::pair<double, double>> began(configs_.size());
  for (std::size_t i = 0; i < configs_.size(); ++i)
    began[i] = {bench_.state(i).setpoint_position_rad,
                bench_.drive(i).simulated().plant().link_state().position_rad};
  double farthest_rad = 0.0;
  for (int k = 0; k < kAfter; ++k) {
    bench_.step();
    for (std::size_t i = 0; i < configs_.size(); ++i) {
      const JointPlant& plant = bench_.drive(i).simulated().plant();
      farthest_rad = std::max({farthest_rad, std::abs(bench_.state(i).setpoint_position_rad - began[i].first),
                               std::abs(plant.link_state().position_rad - began[i].second)});
    }
  }
  return farthest_rad;
}

void RandomPathRide::look(const DrawnPath& path, int cycle, bool full_rate, RideRecord& record) {
  bool all_say_paused = true;
  for (std::size_t i = 0; i < configs_.size(); ++i) {
    const state_v1& state = bench_.state(i);
    Journey& journey = record.journeys[i];
    Last& last = last_[i];
    const bool tracks = bench_.mode(i) == Mode::kTracking;
    if (tracks && journey.begins == 0) journey.begins = cycle;
    const bool on_path = !std::isnan(state.path_time_s);
    if (on_path) journey.ends = cycle;
    if (journey.first_motion == 0 && std::abs(state.setpoint_velocity_rad_s) > kStands_rad_s)
      journey.first_motion = cycle;
    const double path_time_s = on_path ? state.path_time_s : journey.begins == 0 ? 0.0 : path.duration_s();
    const DrawnPoint point = evaluate(path.parts[i], path_time_s);
    const Farthest here{0.0, i, path_time_s, point.velocity_rad_s};
    double setpoint_rad = point.position_rad;
    if (configs_[i].loop.controller.link) {
      const LinkModel& link = *configs_[i].loop.controller.link;
      setpoint_rad += link.link_inertia_kgm2 * point.acceleration_rad_s2 / link.spring.stiffness_1_Nm_rad;
    }
    const bool goes_on = on_path && path_time_s > last.path_time_s;
    if (i == 0 && on_path && path_time_s > 0.0 && !goes_on) ++record.rested;
    all_say_paused = all_say_paused && bench_.has_notice(i, Notice::kPathPaused);
    if (goes_on) record.setpoint_off_rad.see(std::abs(state.setpoint_position_rad - setpoint_rad), here);
    const JointPlant& plant = bench_.drive(i).simulated().plant();
    record.off_rad.see(std::abs(plant.link_state().position_rad - point.position_rad), here);
    if (on_path && full_rate && path_time_s > 0.0)
      record.time_off_s.see(std::abs(path_time_s - last.path_time_s - kPeriod_s), here);
    record.time_apart_s.see(std::abs(path_time_s - last_[0].path_time_s) * (i == 0 ? 0.0 : 1.0), here);
    const double acceleration_rad_s2 = (state.setpoint_velocity_rad_s - last.velocity_rad_s) / kPeriod_s;
    const double jerk_rad_s3 = (acceleration_rad_s2 - last.acceleration_rad_s2) / kPeriod_s;
    if (goes_on) {
      record.speed_rad_s.see(std::abs(state.setpoint_velocity_rad_s), here);
      record.acceleration_rad_s2.see(std::abs(acceleration_rad_s2), here);
      record.jerk_rad_s3.see(std::abs(jerk_rad_s3), here);
    }
    record.path_speed_rad_s.see(std::abs(point.velocity_rad_s), here);
    record.torque_Nm.see(std::abs(bench_.drive(i).command().torque_Nm), here);
    record.notices |= state.notices;
    if (bench_.fault(i) != Fault::kNone) record.fault = bench_.fault(i);
    last = {path_time_s, state.setpoint_position_rad, state.setpoint_velocity_rad_s, acceleration_rad_s2};
  }
  record.said_paused += all_say_paused ? 1 : 0;
}

RideRecord RandomPathRide::ride(const DrawnPath& path, const std::optional<Pause>& pause) {
  RideRecord record;
  record.journeys.resize(configs_.size());
  last_.assign(configs_.size(), {});
  const int most = 2000 + static_cast<int>(1e3 * (path.duration_s() + (pause ? pause->for_s : 0.0)));
  const auto cycle_at = [](double time_s) {
    return std::max(1, static_cast<int>(std::lround(1e3 * time_s)));
  };
  int left = kAfter;
  int cycle = 1;
  for (; cycle < most && left > 0; ++cycle) {
    if (pause && cycle == cycle_at(pause->at_s))
      bench_.order(configs_.size() - 1, OrderKind::kPausePath);
    else if (pause && cycle == cycle_at(pause->at_s + pause->for_s))
      bench_.order(0, OrderKind::kResumePath);
    else
      bench_.step();
    const bool slowed = pause && cycle >= cycle_at(pause->at_s) &&
                        cycle < cycle_at(pause->at_s + pause->for_s + kBackAtFullRate_s);
    look(path, cycle, !slowed, record);
    bool any_tracks = false;
    for (std::size_t i = 0; i < configs_.size(); ++i) any_tracks |= bench_.mode(i) == Mode::kTracking;
    if (!any_tracks && cycle > 10) --left;
  }
  record.arrived = left == 0;
  for (std::size_t i = 0; i < configs_.size(); ++i)
    record.left_rad.see(std::abs(bench_.drive(i).simulated().plant().link_state().position_rad -
                                 path.parts[i].back().position_rad),
                        {0.0, i, path.duration_s(), 0.0});
  return record;
}

}  // namespace strainwave::testing
